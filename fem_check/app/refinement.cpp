#include "fem_check/app/refinement.hpp"

#include <cmath>

namespace vehd::fem_check {

Refinement Refinement::quick() {
  Refinement refinement;
  refinement.cells_per_edge = 2;
  refinement.points_per_edge = 12;
  refinement.potential_first = 4;
  refinement.potential_last = 6;
  refinement.flow_first = 4;
  refinement.flow_last = 6;
  refinement.potential_target = 0.0;
  refinement.flow_target = 0.0;
  refinement.potential_tolerance = 1e-9;
  refinement.flow_tolerance = 1e-7;
  return refinement;
}

meshes::BlockMeshOptions block_mesh_options(const Refinement& refinement, double radius, bool far) {
  meshes::BlockMeshOptions options;
  options.cells_per_edge = refinement.cells_per_edge;
  options.blend_layers = refinement.blend_layers;
  options.shell_layers = refinement.shell_layers;
  options.shell_growth = refinement.shell_growth;
  options.outer_radius = refinement.outer_radius * radius;
  if (!far) return options;
  // Layers grow by a constant factor, so that the inner ones stay where they are.
  const auto thickness = [&](int layers) { return std::pow(refinement.shell_growth, layers) - 1.0; };
  options.outer_radius = radius * (1.0 + (refinement.outer_radius - 1.0) * thickness(refinement.shell_layers + 1) /
                                             thickness(refinement.shell_layers));
  options.shell_layers += 1;
  return options;
}

Meshes::Meshes(const meshes::FrozenShape& shape, const Refinement& refinement) {
  std::vector<meshes::HexMesh> both = meshes::make_block_meshes(
      shape,
      {block_mesh_options(refinement, shape.radius(), false), block_mesh_options(refinement, shape.radius(), true)});
  near_ = std::make_shared<meshes::HexMesh>(std::move(both.front()));
  far_ = std::make_shared<meshes::HexMesh>(std::move(both.back()));
}

}  // namespace vehd::fem_check
