#include "bie/bench/equal_error.hpp"

#include "bie/support/memory_meter.hpp"

namespace vehd {

std::optional<DegreeOfError> degree_of_error(const ExactProblem& problem, double error, int lowest, int highest) {
  const auto at = [&problem](int degree) { return DegreeOfError{degree, problem.solve(degree).error}; };
  DegreeOfError enough = at(highest);
  if (!(enough.error <= error)) return std::nullopt;
  int too_low = lowest - 1;
  while (enough.degree - too_low > 1) {
    const DegreeOfError middle = at((too_low + enough.degree) / 2);
    if (middle.error <= error) {
      enough = middle;
    } else {
      too_low = middle.degree;
    }
  }
  return enough;
}

std::optional<std::int64_t> memory_of(const ExactProblem& problem, int degree) {
  MemoryMeter meter;
  meter.start();
  meter.begin(problem.field);
  (void)problem.solve(degree);
  meter.end();
  const auto found = meter.peaks().find(problem.field);
  if (found == meter.peaks().end()) return std::nullopt;
  return found->second;
}

}  // namespace vehd
