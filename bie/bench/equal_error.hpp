#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace vehd {

/// A problem with a known answer, solved at one degree.
struct SolvedProblem {
  double error = 0.0;          ///< relative to the largest value of the field
  double seconds = 0.0;        ///< tables of the degree excluded, as every solution but the first takes
  double first_seconds = 0.0;  ///< tables included
};

/// A problem with a known answer that can be solved at any degree.
struct ExactProblem {
  std::string field;  ///< whose error it is
  std::function<SolvedProblem(int degree)> solve;
};

/// The lowest degree that is enough for an error.
struct DegreeOfError {
  int degree = 0;
  double error = 0.0;  ///< at this degree
};

/// The lowest degree from lowest to highest at which the error is at most `error`, by bisection; nothing if the highest
/// is not enough. Where errors do not fall from degree to degree the result is enough and the degree below is not.
/// @param lowest  ≥ 1
std::optional<DegreeOfError> degree_of_error(const ExactProblem& problem, double error, int lowest, int highest);

/// Most memory that a solution takes beyond what the process held before, tables of the degree included, see
/// MemoryMeter; nothing where the system does not say.
std::optional<std::int64_t> memory_of(const ExactProblem& problem, int degree);

}  // namespace vehd
