#include "meshes/blended_map.hpp"

#include <algorithm>
#include <limits>

namespace vehd::meshes {
namespace {

/// Smallest extent of the membrane along one axis over the two blocks that the axis cuts.
double room_along(const FrozenShape& shape, const Point& centre, const BlockAxes& axes, int axis) {
  constexpr int kSamples = 17;
  double room = std::numeric_limits<double>::max();
  for (const double sign : {-1.0, 1.0}) {
    for (int i = 0; i < kSamples; ++i) {
      for (int j = 0; j < kSamples; ++j) {
        const double first = 2.0 * i / (kSamples - 1) - 1.0;
        const double second = 2.0 * j / (kSamples - 1) - 1.0;
        const Point direction = BlockMap::cube_direction(axis, sign, first, second);
        const Point x = shape.position(axes.in_directions * direction) - centre;
        room = std::min(room, sign * x.dot(axes.in_space.col(axis)));
      }
    }
  }
  // If there is no room, any width will do: the quality of the elements decides whether the mesh is used.
  return std::max(room, 0.05 * shape.radius());
}

}  // namespace

BlendedMap::BlendedMap(const FrozenShape& shape, const BlockAxes& axes, double outer_radius, double core_fraction)
    : BlockMap(shape, axes, outer_radius) {
  for (int k = 0; k < 3; ++k) {
    core_.col(k) = core_fraction * room_along(shape, centre(), axes, k) * axes.in_space.col(k);
  }
}

Point BlendedMap::in_core(const Point& reference) const { return centre() + core_ * (reference / kCore); }

Point BlendedMap::around_core(const Block& block, const Point& reference, const Point& on_membrane) const {
  const CubePoint p = cube_point(block, reference);
  if (block.layer == Block::Layer::blend) {
    const double t = (p.s - kCore) / (kMembrane - kCore);
    return (1.0 - t) * (centre() + core_ * p.v) + t * on_membrane;
  }
  const double t = (p.s - kMembrane) / (kOuter - kMembrane);
  return (1.0 - t) * on_membrane + t * (centre() + outer_radius() * (block_to_space() * p.g.normalized()));
}

Matrix3 BlendedMap::derivative(const Block& block, const Point& reference) const {
  if (block.layer == Block::Layer::core) return core_ / kCore;
  const CubePoint p = cube_point(block, reference);
  const CubeSlopes slopes = cube_slopes(block, p);
  const Point unit = p.g.normalized();
  const Point r = block_to_direction() * unit;
  const Point x = shape().position(r);
  const Matrix3 x_slope = shape().tangent_map(r) * block_to_direction() * slopes.unit;
  if (block.layer == Block::Layer::blend) {
    const double width = kMembrane - kCore;
    const double t = (p.s - kCore) / width;
    return (1.0 - t) * core_ * slopes.v + t * x_slope + (x - centre() - core_ * p.v) * slopes.s.transpose() / width;
  }
  const double width = kOuter - kMembrane;
  const double t = (p.s - kMembrane) / width;
  const Matrix3 outer = outer_radius() * block_to_space();
  return (1.0 - t) * x_slope + t * outer * slopes.unit + (centre() + outer * unit - x) * slopes.s.transpose() / width;
}

}  // namespace vehd::meshes
