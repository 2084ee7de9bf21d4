#pragma once

#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "fem_check/discretisation.hpp"
#include "meshes/frozen_shape.hpp"

namespace vehd::fem_check {

/// One level of a problem of `vehd bench methods`.
struct LevelTask {
  std::filesystem::path input;
  int degree = 4;
  int cells_per_edge = 3;     ///< the layers of cells are in proportion
  double outer_radius = 8.0;  ///< over the radius of the shape
};

/// Cost of a level.
struct LevelCost {
  int degree = 0, n_cells = 0;
  long n_unknowns = 0;
  double outer_radius = 0.0;
  double seconds = 0.0;  ///< processor time from the shape to the fields on γ: mesh, matrices, solution
  double seconds_mesh = 0.0;
  std::size_t peak_memory_bytes = 0;  ///< of the process
};

/// Relative errors of a field on γ.
struct FieldError {
  double l2 = 0.0, max = 0.0;
};

/// Mesh and elements of a level, with the processor time since the start of their construction.
class LevelSpace {
 public:
  /// @throws meshes::MeshError
  LevelSpace(const meshes::FrozenShape& shape, const LevelTask& task);

  [[nodiscard]] const Discretisation& discretisation() const { return discretisation_; }
  /// Cost up to now, except unknowns and memory, which the solutions provide.
  [[nodiscard]] LevelCost cost_so_far() const;

 private:
  std::clock_t start_;
  double seconds_mesh_ = 0.0, outer_radius_ = 0.0;
  Discretisation discretisation_;

  [[nodiscard]] double elapsed() const;
  [[nodiscard]] Discretisation discretise(const meshes::FrozenShape& shape, const LevelTask& task);
};

/// JSON objects of both.
nlohmann::json json_of(const LevelCost& cost);
nlohmann::json json_of(const FieldError& error);

}  // namespace vehd::fem_check
