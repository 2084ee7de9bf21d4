#include "meshes/frozen_shape.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "meshes/gauss_rule.hpp"

namespace vehd::meshes {
namespace {

/// Calls visit(direction, weight) at every node; Σ weight = 4π. Exact for products of three functions of this degree.
template <typename Visit>
void for_each_node(int degree, const Visit& visit) {
  // The area element is not a polynomial: the rule is exact to at least four times the degree, which resolves it
  // wherever the shape itself is resolved.
  const int n_theta = std::max(2 * degree + 2, 32);
  const GaussRule rule = gauss_rule(n_theta);
  const int n_phi = 2 * n_theta;
  for (int j = 0; j < n_theta; ++j) {
    const double theta = std::acos(rule.node[j]);
    for (int k = 0; k < n_phi; ++k) {
      const double step = 2.0 * std::numbers::pi / n_phi;
      visit(direction_of(theta, k * step), rule.weight[j] * step);
    }
  }
}

Matrix3 affine_part_of(const Eigen::MatrixXd& coefficients) {
  Matrix3 result = Matrix3::Zero();
  if (coefficients.rows() < 4) return result;
  // Y_{1,1}, Y_{1,−1}, Y_{1,0} are x, y, z times √(3/4π).
  const double unit = std::sqrt(0.75 / std::numbers::pi);
  result.col(0) = unit * coefficients.row(3).transpose();
  result.col(1) = unit * coefficients.row(1).transpose();
  result.col(2) = unit * coefficients.row(2).transpose();
  return result;
}

const Eigen::MatrixXd& require_three_columns(const Eigen::MatrixXd& coefficients) {
  if (coefficients.cols() != 3) {
    throw std::invalid_argument(fmt::format("a shape has 3 columns of coefficients, not {}", coefficients.cols()));
  }
  return coefficients;
}

/// n dA/dω from the tangent map: cross product of the images of an orthonormal frame of the tangent plane.
Point area_vector_of(const Point& direction, const Matrix3& tangent_map) {
  const Point first = direction.unitOrthogonal();
  const Point second = direction.cross(first);
  return (tangent_map * first).cross(tangent_map * second);
}

}  // namespace

FrozenShape::FrozenShape(const Eigen::MatrixXd& coefficients)
    : series_(require_three_columns(coefficients)), affine_part_(affine_part_of(coefficients)) {
  Eigen::VectorXd x(3);
  Eigen::MatrixXd tangents(3, 3);
  Point moment = Point::Zero();
  for_each_node(degree(), [&](const Point& direction, double weight) {
    series_.value_and_gradient(direction, x, tangents);
    const Point vector = weight * area_vector_of(direction, tangents);
    area_ += vector.norm();
    volume_ += vector.dot(x) / 3.0;
    moment += 0.5 * x.cwiseAbs2().cwiseProduct(vector);  // ∫ x dV = ∫ ½ x² n_x dA
  });
  if (!(volume_ > 0.0)) {
    throw MeshError(fmt::format("the shape encloses the volume {:.6g}; x_θ × x_φ must point outwards", volume_));
  }
  centroid_ = moment / volume_;
}

Point FrozenShape::area_vector(const Point& direction) const {
  return area_vector_of(direction, tangent_map(direction));
}

double FrozenShape::radius() const { return std::sqrt(area_ / (4.0 * std::numbers::pi)); }

double FrozenShape::largest_distance(const Point& from) const {
  double result = 0.0;
  for_each_node(degree(), [&](const Point& direction, double) {
    result = std::max(result, (position(direction) - from).norm());
  });
  return result;
}

}  // namespace vehd::meshes
