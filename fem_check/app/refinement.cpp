#include "fem_check/app/refinement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "meshes/block_axes.hpp"

namespace vehd::fem_check {

Refinement Refinement::of_strongly_bent() {
  Refinement refinement;
  refinement.cells_per_edge = 6;
  refinement.blend_layers = 2;
  refinement.blend_growth = 4.0;
  refinement.shell_layers = 4;
  refinement.potential_degrees = {3, 4, 5, 6, 7};
  refinement.flow_degrees = {3, 4, 5, 6};
  refinement.shape_flow_degrees = {3, 4, 5, 6};
  return refinement;
}

Refinement Refinement::of_strongly_bent_bowl() {
  Refinement refinement;
  refinement.cells_per_edge = 4;
  refinement.blend_layers = 2;
  refinement.shell_layers = 4;
  // At degree 8 the flow has 1.2 million unknowns on this many cells.
  refinement.flow_degrees.pop_back();
  refinement.shape_flow_degrees.pop_back();
  return refinement;
}

namespace {

bool is_strongly_bent(const meshes::FrozenShape& shape) {
  return meshes::is_strongly_bent(shape, Refinement::finest().cells_per_edge);
}

bool is_bowl(const meshes::FrozenShape& shape) {
  return meshes::cells_have_to_be_relaxed(shape, block_mesh_options(Refinement::of_strongly_bent_bowl(), shape));
}

}  // namespace

Refinement Refinement::following(const meshes::FrozenShape& shape) {
  if (!is_strongly_bent(shape)) return finest();
  return is_bowl(shape) ? of_strongly_bent_bowl() : of_strongly_bent();
}

void Refinement::resolve(int degree) {
  // A quarter of the circumference has degree/4 waves.
  constexpr double points_per_wave = 3.0;
  const double points = points_per_wave * degree / (4.0 * cells_per_edge);
  points_per_edge = std::max(points_per_edge, static_cast<int>(std::ceil(points)));
}

Refinement Refinement::quick() {
  Refinement refinement;
  refinement.potential_degrees = {3, 5, 7};
  refinement.flow_degrees = {3, 5, 7};
  refinement.shape_flow_degrees = {3, 5, 7};
  refinement.potential_target = 0.0;
  refinement.flow_target = 0.0;
  refinement.potential_tolerance = 1e-8;
  refinement.flow_tolerance = 1e-6;
  return refinement;
}

Refinement Refinement::quick_of(const meshes::FrozenShape& shape) {
  Refinement refinement = quick();
  if (!is_strongly_bent(shape) || !is_bowl(shape)) return refinement;
  const Refinement bowl = of_strongly_bent_bowl();
  refinement.cells_per_edge = bowl.cells_per_edge;
  refinement.blend_layers = bowl.blend_layers;
  refinement.shell_layers = bowl.shell_layers;
  for (auto* degrees : {&refinement.potential_degrees, &refinement.flow_degrees, &refinement.shape_flow_degrees}) {
    *degrees = {3, 4, 5};
  }
  return refinement;
}

Refinement Refinement::quick_of_two() {
  Refinement refinement = quick();
  refinement.cells_per_edge = 2;
  refinement.potential_degrees = {4, 5, 6};
  refinement.flow_degrees = {4, 5, 6};
  return refinement;
}

meshes::BlockMeshOptions block_mesh_options(const Refinement& refinement, const meshes::FrozenShape& shape) {
  meshes::BlockMeshOptions options;
  options.cells_per_edge = refinement.cells_per_edge;
  options.blend_layers = refinement.blend_layers;
  options.shell_layers = refinement.shell_layers;
  options.shell_growth = refinement.shell_growth;
  options.blend_growth = refinement.blend_growth;
  options.outer_radius = shape.largest_distance(shape.centroid()) + refinement.outer_distance * shape.radius();
  return options;
}

namespace {

meshes::BoxMeshOptions box_mesh_options(const Refinement& refinement) {
  meshes::BoxMeshOptions options;
  options.cells_per_edge = refinement.cells_per_edge;
  options.blend_layers = refinement.blend_layers;
  options.box_layers = refinement.box_layers;
  options.box_growth = refinement.box_growth;
  options.outer_layers = refinement.outer_layers;
  options.outer_growth = refinement.outer_growth;
  return options;
}

}  // namespace

meshes::BoxMeshOptions two_vesicle_options(const Refinement& refinement,
                                           const std::array<meshes::FrozenShape, 2>& shapes) {
  meshes::BoxMeshOptions options = box_mesh_options(refinement);
  const meshes::Point middle = 0.5 * (shapes[0].centroid() + shapes[1].centroid());
  const double reach = std::max(shapes[0].largest_distance(middle), shapes[1].largest_distance(middle));
  // Two vesicles far apart fill more of the sphere than a single one.
  const double size = std::max(std::hypot(shapes[0].radius(), shapes[1].radius()), 0.5 * reach);
  options.boxes.outer_radius = refinement.outer_radius_of_two * size;
  return options;
}

meshes::BoxMeshOptions wall_mesh_options(const Refinement& refinement, const meshes::FrozenShape& shape,
                                         const meshes::Wall& wall) {
  constexpr double layer_factor = 2.5;  // ratio of the total thickness of the layers for one more layer
  constexpr double room = 1.2;          // of the outer sphere around the box
  meshes::BoxMeshOptions options = box_mesh_options(refinement);
  options.outer_layers = 1;
  const double reach = shape.largest_distance(shape.centroid()), gap = meshes::gap_to(wall, shape);
  const double least_margin = options.boxes.margin * shape.radius(), margin = std::max(least_margin, gap);
  options.box_layers += static_cast<int>(std::lround(std::log(margin / least_margin) / std::log(layer_factor)));
  const double height = wall.normal.dot(shape.centroid() - wall.point), half_width = reach + margin;
  options.boxes.outer_radius = std::max(height + reach + refinement.outer_distance * shape.radius(),
                                        room * std::hypot(half_width, half_width, height + half_width));
  return options;
}

Meshes::Meshes(const std::vector<meshes::FrozenShape>& shapes, const Refinement& refinement,
               const std::optional<meshes::Wall>& wall)
    : points_per_edge_(refinement.points_per_edge) {
  if (shapes.size() == 2) {
    const std::array pair{shapes[0], shapes[1]};
    mesh_ =
        std::make_shared<meshes::BoxMesh>(meshes::make_two_vesicle_mesh(pair, two_vesicle_options(refinement, pair)));
    return;
  }
  if (shapes.size() != 1) throw meshes::MeshError(fmt::format("has {} vesicles; accepted: one or two", shapes.size()));
  const meshes::FrozenShape& shape = shapes.front();
  if (wall) {
    mesh_ = std::make_shared<meshes::BoxMesh>(
        meshes::make_mesh_beside_wall(shape, *wall, wall_mesh_options(refinement, shape, *wall)));
    return;
  }
  mesh_ = std::make_shared<meshes::HexMesh>(meshes::make_block_mesh(shape, block_mesh_options(refinement, shape)));
}

const Discretisation& Meshes::discretise(int degree) {
  const auto found = discretisations_.find(degree);
  if (found != discretisations_.end()) return found->second;
  return discretisations_.emplace(degree, Discretisation(mesh_, degree, Ranks::all, points_per_edge_)).first->second;
}

}  // namespace vehd::fem_check
