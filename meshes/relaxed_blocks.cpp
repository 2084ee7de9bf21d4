#include "meshes/relaxed_blocks.hpp"

#include <algorithm>
#include <cmath>

#include "meshes/block_map.hpp"
#include "meshes/breaks.hpp"
#include "meshes/relaxation.hpp"

namespace vehd::meshes {
namespace {

/// Two cells along an edge suffice for a smooth map at a low cost; their deviation from γ is corrected by RelaxedMap.
/// At degree 3 the energy decreases much more slowly.
constexpr int kCellsPerEdge = 2;
constexpr int kDegree = 4;

/// Direction V g/|g| of a point outside the core.
Point direction_of(const BlockPlace& place, const BlockAxes& axes) {
  return axes.in_directions * BlockMap::cube_direction(place.block.axis, place.block.sign, place.at.x(), place.at.y());
}

/// Blocks of the unit sphere and of the shell around it, rotated by V.
Point undistorted(const BlockPlace& place, const BlockAxes& axes, double core_half_width, double thickness) {
  if (place.block.layer == Block::Layer::core) return core_half_width * (axes.in_directions * place.at);
  const Point direction = direction_of(place, axes);
  const double t = place.at.z();
  if (place.block.layer == Block::Layer::shell) return (1.0 + t * thickness) * direction;
  Point v;
  v[place.block.axis] = place.block.sign;
  v[(place.block.axis + 1) % 3] = place.at.x();
  v[(place.block.axis + 2) % 3] = place.at.y();
  return (1.0 - t) * core_half_width * (axes.in_directions * v) + t * direction;
}

/// Nodes of one side, in units of the radius of the shape.
Eigen::Matrix3Xd relaxed(const FrozenShape& shape, const BlockAxes& axes, const Lattice& lattice, double core_fraction,
                         double thickness) {
  const double core_half_width = core_fraction / std::sqrt(3.0);
  const Matrix3 turn = axes.in_space * axes.in_directions.transpose();
  const auto n_nodes = static_cast<Eigen::Index>(lattice.nodes().size());
  Eigen::Matrix3Xd sphere(3, n_nodes);
  Eigen::Matrix3Xd end(3, n_nodes);
  for (Eigen::Index i = 0; i < n_nodes; ++i) {
    const Lattice::Node& node = lattice.nodes()[static_cast<std::size_t>(i)];
    sphere.col(i) = undistorted(node.place, axes, core_half_width, thickness);
    end.col(i) = turn * sphere.col(i);
    if (node.boundary == Lattice::Boundary::membrane) {
      end.col(i) = (shape.position(direction_of(node.place, axes)) - shape.centroid()) / shape.radius();
    }
  }
  const Eigen::Matrix3Xd start = turn * sphere;
  return relaxed_nodes(lattice, Distortion(lattice, sphere), start,
                       [&](double share) -> Eigen::Matrix3Xd { return (1.0 - share) * start + share * end; });
}

}  // namespace

RelaxedBlocks::Layers RelaxedBlocks::relaxed_layers(const FrozenShape& shape, const BlockMeshOptions& options) {
  constexpr int kFewest = 2;
  constexpr double kRoom = 1.15;
  const double reach = kRoom * shape.largest_distance(shape.centroid());
  const double thickness = options.outer_radius - shape.radius();
  Layers result{layer_breaks(options.shell_layers, shell_growth(options, shape.radius())), thickness};
  int layers = std::min(kFewest, options.shell_layers);
  while (layers < options.shell_layers && shape.radius() + result.breaks[layers] * thickness < reach) ++layers;
  result.breaks.resize(static_cast<std::size_t>(layers) + 1);
  const double share = result.breaks.back();
  for (double& value : result.breaks) value /= share;
  result.thickness *= share;
  return result;
}

RelaxedBlocks::RelaxedBlocks(const FrozenShape& shape, const BlockAxes& axes, const BlockMeshOptions& options)
    : RelaxedBlocks(shape, axes, options, relaxed_layers(shape, options)) {}

RelaxedBlocks::RelaxedBlocks(const FrozenShape& shape, const BlockAxes& axes, const BlockMeshOptions& options,
                             const Layers& layers)
    : thickness_(layers.thickness),
      end_radius_(shape.radius() + layers.thickness),
      inside_(Region::inside, kCellsPerEdge, kDegree, layer_breaks(options.blend_layers, 1.0 / options.blend_growth)),
      outside_(Region::outside, kCellsPerEdge, kDegree, layers.breaks) {
  const double radius = shape.radius();
  inside_nodes_ = radius * relaxed(shape, axes, inside_, options.core_fraction, 0.0);
  outside_nodes_ = radius * relaxed(shape, axes, outside_, options.core_fraction, thickness_ / radius);
}

}  // namespace vehd::meshes
