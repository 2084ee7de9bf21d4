#include "meshes/block_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace vehd::meshes {
namespace {

constexpr double kQuarterPi = 0.25 * std::numbers::pi;

/// What the formulas of a block share: s, v = X/s and g.
struct CubePoint {
  double s;
  Point v;
  Point g;
};

CubePoint cube_point(const Block& block, const Point& reference) {
  CubePoint result;
  result.s = block.sign * reference[block.axis];
  result.v = reference / result.s;
  for (int k = 0; k < 3; ++k) result.g[k] = k == block.axis ? block.sign : std::tan(kQuarterPi * result.v[k]);
  return result;
}

/// Least extent of the membrane along one axis over the two blocks that this axis cuts.
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
  // No room at all: some width is needed to go on, and the quality of the elements tells whether it was good.
  return std::max(room, 0.05 * shape.radius());
}

}  // namespace

BlockMap::BlockMap(const FrozenShape& shape, const BlockAxes& axes, double outer_radius, double core_fraction)
    : shape_(shape),
      centre_(shape.centroid()),
      outer_radius_(outer_radius),
      block_to_direction_(axes.in_directions),
      block_to_space_(axes.in_space) {
  const double reach = shape.largest_distance(centre_);
  if (!(outer_radius > reach)) {
    throw MeshError(
        fmt::format("outer radius {:.6g} does not hold the membrane, which reaches {:.6g} from its centroid "
                    "({:.6g}, {:.6g}, {:.6g})",
                    outer_radius, reach, centre_.x(), centre_.y(), centre_.z()));
  }
  for (int k = 0; k < 3; ++k) core_.col(k) = core_fraction * room_along(shape, centre_, axes, k) * axes.in_space.col(k);
}

Block BlockMap::block_at(const Point& reference) {
  Eigen::Index axis = 0;
  const double s = reference.cwiseAbs().maxCoeff(&axis);
  const Block::Layer layer = s < kCore ? Block::Layer::core : s < kMembrane ? Block::Layer::blend : Block::Layer::shell;
  return {layer, static_cast<int>(axis), reference[axis] < 0.0 ? -1.0 : 1.0};
}

Point BlockMap::cube_direction(int axis, double sign, double first, double second) {
  Point g;
  g[axis] = sign;
  g[(axis + 1) % 3] = std::tan(kQuarterPi * first);
  g[(axis + 2) % 3] = std::tan(kQuarterPi * second);
  return g.normalized();
}

Point BlockMap::direction(const Block& block, const Point& reference) const {
  return block_to_direction_ * cube_point(block, reference).g.normalized();
}

Point BlockMap::blended(const Block& block, const Point& reference, const Point& on_membrane) const {
  const CubePoint p = cube_point(block, reference);
  if (block.layer == Block::Layer::blend) {
    const double t = (p.s - kCore) / (kMembrane - kCore);
    return (1.0 - t) * (centre_ + core_ * p.v) + t * on_membrane;
  }
  const double t = (p.s - kMembrane) / (kOuter - kMembrane);
  return (1.0 - t) * on_membrane + t * (centre_ + outer_radius_ * (block_to_space_ * p.g.normalized()));
}

Point BlockMap::position(const Block& block, const Point& reference) const {
  if (block.layer == Block::Layer::core) return centre_ + core_ * (reference / kCore);
  return blended(block, reference, shape_.position(direction(block, reference)));
}

Eigen::Matrix3Xd BlockMap::positions(const Block& block, const Eigen::Matrix3Xd& reference) const {
  if (block.layer == Block::Layer::core) return (core_ * (reference / kCore)).colwise() + centre_;
  Eigen::Matrix3Xd result(3, reference.cols());
  for (Eigen::Index i = 0; i < reference.cols(); ++i) result.col(i) = direction(block, reference.col(i));
  result = shape_.positions(result);
  for (Eigen::Index i = 0; i < reference.cols(); ++i) {
    result.col(i) = blended(block, reference.col(i), result.col(i));
  }
  return result;
}

Matrix3 BlockMap::derivative(const Block& block, const Point& reference) const {
  if (block.layer == Block::Layer::core) return core_ / kCore;
  const CubePoint p = cube_point(block, reference);
  const Point unit = p.g.normalized();
  const Point s_slope = block.sign * Point::Unit(block.axis);
  const Matrix3 v_slope = (Matrix3::Identity() - p.v * s_slope.transpose()) / p.s;
  const Point g_slope = kQuarterPi * (1.0 + p.g.array().square());
  const Matrix3 unit_slope =
      (Matrix3::Identity() - unit * unit.transpose()) / p.g.norm() * (g_slope.asDiagonal() * v_slope);
  const Point r = block_to_direction_ * unit;
  const Point x = shape_.position(r);
  const Matrix3 x_slope = shape_.tangent_map(r) * block_to_direction_ * unit_slope;
  if (block.layer == Block::Layer::blend) {
    const double width = kMembrane - kCore;
    const double t = (p.s - kCore) / width;
    return (1.0 - t) * core_ * v_slope + t * x_slope + (x - centre_ - core_ * p.v) * s_slope.transpose() / width;
  }
  const double width = kOuter - kMembrane;
  const double t = (p.s - kMembrane) / width;
  const Matrix3 outer = outer_radius_ * block_to_space_;
  return (1.0 - t) * x_slope + t * outer * unit_slope + (centre_ + outer * unit - x) * s_slope.transpose() / width;
}

}  // namespace vehd::meshes
