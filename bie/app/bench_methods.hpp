#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vehd {

/// A sequence of ever finer solutions by one method.
struct MethodCurve {
  std::string name;   ///< in the CSV and the JSON
  std::string label;  ///< in the table and the picture
};

/// One solution: the point-source problem of Example 1 on shape (33), on one core.
struct MethodLevel {
  MethodCurve curve;
  int degree = 0;          ///< of the harmonics, or of the elements
  int cells_per_edge = 0;  ///< of a block of the mesh; 0 without a mesh
  std::int64_t unknowns = 0;
  std::vector<double> seconds;  ///< of the processor, from the shape to q and f_E: tables, mesh, matrices; each repeat
  std::int64_t peak_memory_bytes = 0;
  double charge_l2 = 0.0, charge_max = 0.0, force_l2 = 0.0, force_max = 0.0;  ///< relative errors
};

struct MethodsTask {
  std::filesystem::path directory;
  bool quick = false;
  bool plot = true;
  int repeats = 3;
};

/// Boundary integrals against finite elements: prints a table; writes methods.csv, methods.json and methods.png.
/// @return the content of methods.json
/// @throws InputError if the finite-element program is not there
nlohmann::json bench_methods(const MethodsTask& task);

/// Error of q against seconds and against unknowns, from methods.csv.
void draw_methods(const std::filesystem::path& directory, const std::vector<MethodCurve>& curves);

}  // namespace vehd
