#include "meshes/box_map.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "meshes/surface_samples.hpp"

namespace vehd::meshes {
namespace {

/// Factor of a face coordinate in g = tan(π v/4).
constexpr double kAngle = 0.25 * std::numbers::pi;

/// Extent of points along the columns of `axes`.
struct Extent {
  Point low, high;
};
Extent extent_along(const Matrix3& axes, const Eigen::Matrix3Xd& points) {
  const Eigen::Matrix3Xd along = axes.transpose() * points;
  return {along.rowwise().minCoeff(), along.rowwise().maxCoeff()};
}

/// Derivatives of u/|u|.
template <typename Slopes>
Slopes unit_slopes(const Point& u, const Slopes& slopes) {
  const Point unit = u.normalized();
  return (slopes - unit * (unit.transpose() * slopes)) / u.norm();
}

/// The wall as the plane between a shape and its mirror image, with the gap: half the slab between them.
SeparatingPlane plane_beside(const FrozenShape& shape, const Wall& wall) {
  const double gap = gap_to(wall, shape);
  if (gap > 0.0) return {-wall.normal, -wall.normal.dot(wall.point), gap};
  throw MeshError(fmt::format("the membrane reaches {:.6g} beyond the wall", -gap));
}

}  // namespace

/// The third axis is the normal of the plane. The first one is the direction across it in which the shapes are longest
/// or, if there is none, the projection of the coordinate axis that is most nearly perpendicular to the normal.
Matrix3 BoxMap::axes_along(const Point& normal, const std::vector<FrozenShape>& shapes) {
  constexpr double kMarked = 1.02;
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  Matrix3 axes;
  axes.col(2) = normal;
  axes.col(0) = (Point::Unit(least) - normal[least] * normal).normalized();
  axes.col(1) = normal.cross(axes.col(0));
  Matrix3 stretch = Matrix3::Zero();
  for (const FrozenShape& shape : shapes) stretch += shape.affine_part() * shape.affine_part().transpose();
  const Eigen::Matrix<double, 3, 2> across = axes.leftCols<2>();
  const Eigen::Matrix2d across_stretch = across.transpose() * stretch * across;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal;
  principal.computeDirect(across_stretch);
  if (principal.eigenvalues()[1] > kMarked * principal.eigenvalues()[0]) {
    axes.col(0) = across * principal.eigenvectors().col(1);
    axes.col(1) = normal.cross(axes.col(0));
  }
  return axes;
}

/// `fraction` times the largest box parallel to M A about the centroid that fits inside the membrane.
Matrix3 BoxMap::core_of(const Box& box, double fraction) {
  const Matrix3 widths = box.shape.affine_part() * box.to_direction;
  const Eigen::Matrix3Xd points = surface_samples(box.shape).colwise() - box.shape.centroid();
  const Eigen::Matrix3Xd scaled = widths.inverse() * points;
  return fraction * scaled.cwiseAbs().colwise().maxCoeff().minCoeff() * widths;
}

BoxMap::BoxMap(const std::array<FrozenShape, 2>& shapes, const BoxOptions& options)
    : BoxMap({shapes[0], shapes[1]}, {shapes[0], shapes[1]}, separating_plane(shapes[0], shapes[1]), options) {}

BoxMap::BoxMap(const FrozenShape& shape, const FrozenShape& like, const Wall& wall, const BoxOptions& options)
    : BoxMap(std::vector{shape}, std::vector{like}, plane_beside(shape, wall), options) {}

BoxMap::BoxMap(const std::vector<FrozenShape>& shapes, const std::vector<FrozenShape>& like,
               const SeparatingPlane& plane, const BoxOptions& options)
    : beside_wall_(shapes.size() == 1), centre_(Point::Zero()), outer_radius_(options.outer_radius) {
  const Matrix3 axes = axes_along(plane.normal, like);
  std::vector<Extent> extents;
  double radius = 0.0;
  for (const FrozenShape& shape : shapes) {
    extents.push_back(extent_along(axes, surface_samples(shape)));
    radius = std::max(radius, shape.radius());
  }
  // Far from its wall, a vesicle has a box as wide as it is long.
  const double margin = std::max(options.margin * radius, beside_wall_ ? plane.width : 0.0);
  const Point low = extents.front().low.cwiseMin(extents.back().low).array() - margin;
  Point high = extents.front().high.cwiseMax(extents.back().high).array() + margin;
  if (beside_wall_) high[2] = 2.0 * plane.offset - low[2];
  centre_ = axes * (0.5 * (low + high));
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    Point box_low = low, box_high = high;
    (k == 0 ? box_high : box_low)[2] = plane.offset;
    const Extent of_like = extent_along(axes, surface_samples(like[k]));
    const Matrix3 widths = axes * (0.5 * (of_like.high - of_like.low)).asDiagonal();
    Box box{shapes[k], like[k].affine_part().inverse() * widths, Matrix3::Zero(), axes * (0.5 * (box_low + box_high)),
            axes * (0.5 * (box_high - box_low)).asDiagonal()};
    if (!(box.to_direction.determinant() > 0.0)) {
      throw MeshError(
          fmt::format("a membrane whose best ellipsoid is turned inside out, about ({:.6g}, {:.6g}, {:.6g})",
                      box.shape.centroid().x(), box.shape.centroid().y(), box.shape.centroid().z()));
    }
    box.core = core_of(box, options.core_fraction);
    boxes_.push_back(std::move(box));
  }
  const double reach = 0.5 * (high - low).norm();
  if (!(outer_radius_ > reach)) {
    throw MeshError(fmt::format(
        "outer radius {:.6g} does not enclose the boxes about the membranes, which reach {:.6g} from their middle "
        "({:.6g}, {:.6g}, {:.6g})",
        outer_radius_, reach, centre_.x(), centre_.y(), centre_.z()));
  }
}

BoxMap::CubePoint BoxMap::cube_point(const BoxBlock& block, const Point& at) {
  const int first = (block.axis + (block.sign > 0.0 ? 1 : 2)) % 3, second = 3 - block.axis - first;
  CubePoint result{block.sign * Point::Unit(block.axis), block.sign * Point::Unit(block.axis), Slopes::Zero(),
                   Slopes::Zero()};
  for (int k = 0; k < 2; ++k) {
    const int axis = k == 0 ? first : second;
    result.v[axis] = at[k];
    result.g[axis] = std::tan(kAngle * at[k]);
    result.v_slopes(axis, k) = 1.0;
    result.g_slopes(axis, k) = kAngle * (1.0 + result.g[axis] * result.g[axis]);
  }
  return result;
}

Point BoxMap::direction(const BoxBlock& block, const Point& at) const {
  return (boxes_[block.vesicle].to_direction * cube_point(block, at).g).normalized();
}

BoxMap::SurfacePoint BoxMap::on_core(const BoxBlock& block, const CubePoint& point) const {
  const Box& box = boxes_[block.vesicle];
  return {box.shape.centroid() + box.core * point.v, box.core * point.v_slopes};
}

BoxMap::SurfacePoint BoxMap::on_membrane(const BoxBlock& block, const CubePoint& point) const {
  const Box& box = boxes_[block.vesicle];
  const Point u = box.to_direction * point.g, r = u.normalized();
  return {box.shape.position(r), box.shape.tangent_map(r) * unit_slopes(u, Slopes(box.to_direction * point.g_slopes))};
}

BoxMap::SurfacePoint BoxMap::on_box(const BoxBlock& block, const CubePoint& point) const {
  const Box& box = boxes_[block.vesicle];
  return {box.middle + box.half * point.g, box.half * point.g_slopes};
}

/// End points of the lines from the membrane: on the box; on a wall mainly the feet of the points of the membrane.
BoxMap::SurfacePoint BoxMap::on_face(const BoxBlock& block, const CubePoint& point,
                                     const SurfacePoint& membrane) const {
  SurfacePoint result = on_box(block, point);
  if (!beside_wall_ || block.axis != 2 || block.sign < 0.0) return result;
  const Point normal = boxes_[block.vesicle].half.col(2).normalized();
  const Matrix3 onto = Matrix3::Identity() - normal * normal.transpose();
  const double x = point.v.x(), y = point.v.y(), share = (1.0 - x * x) * (1.0 - y * y);
  const Point share_slope(-2.0 * x * (1.0 - y * y), -2.0 * y * (1.0 - x * x), 0.0);
  const Point way = onto * (membrane.at - result.at);
  result.at += share * way;
  result.slopes += share * (onto * membrane.slopes - result.slopes) + way * (share_slope.transpose() * point.v_slopes);
  return result;
}

BoxMap::SurfacePoint BoxMap::on_sphere(const SurfacePoint& on_box) const {
  const Point away = on_box.at - centre_;
  return {centre_ + outer_radius_ * away.normalized(), outer_radius_ * unit_slopes(away, on_box.slopes)};
}

Point BoxMap::place(const BoxBlock& block, const Point& at, const Point& on_membrane) const {
  const CubePoint point = cube_point(block, at);
  const double t = at.z();
  if (block.layer == BoxBlock::Layer::blend) return (1.0 - t) * on_core(block, point).at + t * on_membrane;
  if (block.layer == BoxBlock::Layer::box) {
    return (1.0 - t) * on_membrane + t * on_face(block, point, {on_membrane, Slopes::Zero()}).at;
  }
  const SurfacePoint box = on_box(block, point);
  return (1.0 - t) * box.at + t * on_sphere(box).at;
}

Point BoxMap::position(const BoxBlock& block, const Point& at) const { return positions(block, at).col(0); }

Eigen::Matrix3Xd BoxMap::positions(const BoxBlock& block, const Eigen::Matrix3Xd& at) const {
  const Box& box = boxes_[block.vesicle];
  if (block.layer == BoxBlock::Layer::core) return (box.core * at).colwise() + box.shape.centroid();
  Eigen::Matrix3Xd result(3, at.cols());
  if (block.layer != BoxBlock::Layer::outer) {
    for (Eigen::Index i = 0; i < at.cols(); ++i) result.col(i) = direction(block, at.col(i));
    result = box.shape.positions(result);
  }
  for (Eigen::Index i = 0; i < at.cols(); ++i) result.col(i) = place(block, at.col(i), result.col(i));
  return result;
}

Matrix3 BoxMap::derivative(const BoxBlock& block, const Point& at) const {
  if (block.layer == BoxBlock::Layer::core) return boxes_[block.vesicle].core;
  const CubePoint point = cube_point(block, at);
  const double t = at.z();
  SurfacePoint from, to;
  if (block.layer == BoxBlock::Layer::blend) {
    from = on_core(block, point);
    to = on_membrane(block, point);
  } else if (block.layer == BoxBlock::Layer::box) {
    from = on_membrane(block, point);
    to = on_face(block, point, from);
  } else {
    from = on_box(block, point);
    to = on_sphere(from);
  }
  Matrix3 result;
  result << (1.0 - t) * from.slopes + t * to.slopes, to.at - from.at;
  return result;
}

}  // namespace vehd::meshes
