#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bie/bench/result.hpp"
#include "bie/bench/shape_flow_problem.hpp"

namespace vehd {

/// A sequence of ever finer solutions by one method.
struct MethodCurve {
  std::string name;   ///< in the CSV and the JSON
  std::string label;  ///< in the table and the picture
};

/// One solution on one core.
struct MethodLevel {
  MethodCurve curve;
  int degree = 0;          ///< of the harmonics, or of the elements
  int cells_per_edge = 0;  ///< of a block of the mesh; 0 without a mesh
  std::int64_t unknowns = 0;
  std::vector<double> seconds;  ///< of the processor, from the shape to the fields on γ; each repeat
  std::optional<std::int64_t> peak_memory_bytes;
  MethodError first, second;  ///< of q and f_E, or of v and λ
};

/// How much is measured.
struct MethodsTask {
  bool quick = false;  ///< two levels of each
  int repeats = 3;
};

/// Boundary integrals against finite elements, both on one thread: the point sources of Example 1 on shape (33), whose
/// solution is known, and as a further table all that a step solves for, ShapeFlowProblem.
/// @param folder  for files that are gone at the end
/// @throws InputError if the finite-element program is not there
BenchResult bench_methods(const MethodsTask& task, const std::filesystem::path& folder, BenchObserver& observer);

}  // namespace vehd
