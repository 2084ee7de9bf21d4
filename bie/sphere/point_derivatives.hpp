#pragma once

#include <vector>

#include "bie/sphere/neighbourhood.hpp"

namespace vehd {

/// Fields at one point of the unit sphere with covariant derivatives in its frame (e_θ, e_φ), one column per field.
/// Finite at the poles.
struct PointDerivatives {
  Eigen::RowVectorXd value, d1, d2, d11, d12, d22;

  /// (d1, d2) of one field.
  [[nodiscard]] Eigen::Vector2d gradient(Index column) const { return {d1[column], d2[column]}; }
  /// (d11, d12; d12, d22) of one field.
  [[nodiscard]] Eigen::Matrix2d hessian(Index column) const;
};

/// Values and covariant derivatives of all fields at one point.
/// @param coefficients     [n_coefficients x n_fields]
/// @param azimuthal_order  largest |m| with a coefficient that is not zero, see azimuthal_order_of
/// @throws ShapeError if the number of rows is not (p + 1)²
/// Accuracy: rounding, as for the transform (tests/sphere/point_derivatives_test.cpp)
PointDerivatives point_derivatives(const Matrix& coefficients, const SpherePoint& point, int azimuthal_order);
/// point_derivatives of fields with any m, from coefficients [n_coefficients x n_fields].
PointDerivatives point_derivatives(const Matrix& coefficients, const SpherePoint& point);

/// point_derivatives at many points from coefficients [n_coefficients x n_fields], four times as fast as single points.
std::vector<PointDerivatives> point_derivatives(const Matrix& coefficients, const std::vector<SpherePoint>& points);

}  // namespace vehd
