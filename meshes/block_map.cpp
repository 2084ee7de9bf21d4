#include "meshes/block_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace vehd::meshes {
namespace {

constexpr double kQuarterPi = 0.25 * std::numbers::pi;

}  // namespace

BlockMap::BlockMap(const FrozenShape& shape, const BlockAxes& axes, double outer_radius)
    : shape_(shape), centre_(shape.centroid()), outer_radius_(outer_radius), axes_(axes) {
  const double reach = shape.largest_distance(centre_);
  if (!(outer_radius > reach)) {
    throw MeshError(
        fmt::format("outer radius {:.6g} does not enclose the membrane, which reaches {:.6g} from its centroid "
                    "({:.6g}, {:.6g}, {:.6g})",
                    outer_radius, reach, centre_.x(), centre_.y(), centre_.z()));
  }
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

BlockMap::CubePoint BlockMap::cube_point(const Block& block, const Point& reference) {
  CubePoint result;
  result.s = block.sign * reference[block.axis];
  result.v = reference / result.s;
  for (int k = 0; k < 3; ++k) result.g[k] = k == block.axis ? block.sign : std::tan(kQuarterPi * result.v[k]);
  return result;
}

BlockMap::CubeSlopes BlockMap::cube_slopes(const Block& block, const CubePoint& point) {
  CubeSlopes result;
  const Point unit = point.g.normalized();
  result.s = block.sign * Point::Unit(block.axis);
  result.v = (Matrix3::Identity() - point.v * result.s.transpose()) / point.s;
  const Point g_slope = kQuarterPi * (1.0 + point.g.array().square());
  result.unit = (Matrix3::Identity() - unit * unit.transpose()) / point.g.norm() * (g_slope.asDiagonal() * result.v);
  return result;
}

Point BlockMap::direction(const Block& block, const Point& reference) const {
  return axes_.in_directions * cube_point(block, reference).g.normalized();
}

Point BlockMap::position(const Block& block, const Point& reference) const {
  if (block.layer == Block::Layer::core) return in_core(reference);
  return around_core(block, reference, shape_.position(direction(block, reference)));
}

Eigen::Matrix3Xd BlockMap::positions(const Block& block, const Eigen::Matrix3Xd& reference) const {
  Eigen::Matrix3Xd result(3, reference.cols());
  if (block.layer == Block::Layer::core) {
    for (Eigen::Index i = 0; i < reference.cols(); ++i) result.col(i) = in_core(reference.col(i));
    return result;
  }
  for (Eigen::Index i = 0; i < reference.cols(); ++i) result.col(i) = direction(block, reference.col(i));
  result = shape_.positions(result);
  for (Eigen::Index i = 0; i < reference.cols(); ++i) {
    result.col(i) = around_core(block, reference.col(i), result.col(i));
  }
  return result;
}

}  // namespace vehd::meshes
