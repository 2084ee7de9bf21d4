#include "fem_check/app/level_task.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "meshes/volume_mesh.hpp"

namespace vehd::fem_check {
namespace {

/// Layers of cells per cell along an edge of a block; in the shell, for the default outer radius.
constexpr double blend_layers = 1.0 / 3.0, shell_layers = 4.0 / 3.0;

meshes::BlockMeshOptions mesh_options(const LevelTask& task, double radius) {
  const auto layers = [&](double share) {
    return std::max(1, static_cast<int>(std::lround(share * task.cells_per_edge)));
  };
  const double further = std::log(task.outer_radius) / std::log(LevelTask().outer_radius);
  meshes::BlockMeshOptions options;
  options.cells_per_edge = task.cells_per_edge;
  options.blend_layers = layers(blend_layers);
  options.shell_layers = layers(shell_layers * further);
  options.outer_radius = task.outer_radius * radius;
  return options;
}

}  // namespace

LevelSpace::LevelSpace(const meshes::FrozenShape& shape, const LevelTask& task)
    : start_(std::clock()), discretisation_(discretise(shape, task)) {}

Discretisation LevelSpace::discretise(const meshes::FrozenShape& shape, const LevelTask& task) {
  const auto mesh =
      std::make_shared<meshes::HexMesh>(meshes::make_block_mesh(shape, mesh_options(task, shape.radius())));
  seconds_mesh_ = elapsed();
  outer_radius_ = mesh->outer_radius();
  return {mesh, task.degree};
}

double LevelSpace::elapsed() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

LevelCost LevelSpace::cost_so_far() const {
  LevelCost cost;
  cost.degree = discretisation_.degree();
  cost.n_cells = discretisation_.n_cells();
  cost.outer_radius = outer_radius_;
  cost.seconds = elapsed();
  cost.seconds_mesh = seconds_mesh_;
  return cost;
}

nlohmann::json json_of(const LevelCost& cost) {
  return {{"degree", cost.degree},
          {"cells", cost.n_cells},
          {"dofs", cost.n_unknowns},
          {"truncation_radius", cost.outer_radius},
          {"seconds", cost.seconds},
          {"seconds_mesh", cost.seconds_mesh},
          {"memory_bytes", cost.peak_memory_bytes}};
}

nlohmann::json json_of(const FieldError& error) { return {{"l2", error.l2}, {"max", error.max}}; }

}  // namespace vehd::fem_check
