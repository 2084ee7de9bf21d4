#include "bie/sphere/axis_crossing.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace vehd {
namespace {

/// The highest node within a tenth of the surface's size of the line; without any, the nearest above or below.
Index starting_node(const Vector3& point, const Matrix& nodes) {
  constexpr double kNear = 0.1;
  const Vector distance = (nodes.leftCols(2).rowwise() - point.head<2>().transpose()).rowwise().norm();
  const double size = (nodes.rowwise() - point.transpose()).rowwise().norm().maxCoeff();
  Index highest = -1, nearest = 0;
  distance.minCoeff(&nearest);
  for (Index node = 0; node < nodes.rows(); ++node) {
    if (distance[node] > kNear * size || nodes(node, 2) <= point.z()) continue;
    if (highest < 0 || nodes(node, 2) > nodes(highest, 2)) highest = node;
  }
  return highest < 0 ? nearest : highest;
}

/// The surface at one point: x and y from the line, and their derivatives.
struct View {
  Eigen::Vector2d offset;
  Eigen::Matrix2d slopes;
};

}  // namespace

SpherePoint crossing_above(const Vector3& point, const SphereGrid& grid, const Matrix& nodes,
                           const Matrix& coefficients) {
  constexpr int kMost = 50;
  constexpr double kLongest = 0.3;
  constexpr double kShortest = 1e-15;
  constexpr double kLeastShare = 1e-2;
  SpherePoint at = point_of(grid, starting_node(point, nodes));
  const int azimuthal_order =
      std::max(azimuthal_order_of(coefficients.col(0)), azimuthal_order_of(coefficients.col(1)));
  const auto look = [&](const SpherePoint& there) {
    View view;
    for (Index axis = 0; axis < 2; ++axis) {
      const LocalField x = derivatives_at(coefficients.col(axis), there, azimuthal_order);
      view.offset[axis] = x.value - point[axis];
      view.slopes.row(axis) = x.gradient.transpose();
    }
    return view;
  };
  View here = look(at);
  double share = 1.0;
  for (int count = 0; count < kMost && share > kLeastShare; ++count) {
    Eigen::Vector2d step = -share * here.slopes.fullPivLu().solve(here.offset);
    const double length = step.norm();
    if (!(length > kShortest)) break;
    if (length > kLongest) step *= kLongest / length;
    const SpherePoint end = point_of(TangentFrame(at).moved(step));
    const View there = look(end);
    if (there.offset.norm() >= here.offset.norm()) {
      share *= 0.5;
      continue;
    }
    share = 1.0;
    at = end;
    here = there;
  }
  return at;
}

}  // namespace vehd
