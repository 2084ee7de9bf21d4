#include "bie/stepping/evaluation/volume_moments.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/sphere/principal_axes.hpp"

namespace vehd {
namespace {

/// ∫ (a·n) f dA for every column f.
Eigen::RowVectorXd flux_integral(const Surface& s, const Matrix& a, const Matrix& f) {
  const Vector flux = a.cwiseProduct(s.normal).rowwise().sum().cwiseProduct(s.quadrature);
  return flux.transpose() * f;
}

}  // namespace

double VolumeMoments::aspect_ratio() const {
  const Vector3 squares = principal_axes(spread).values;
  return std::sqrt(squares[2] / squares[0]);
}

double VolumeMoments::aspect_ratio_along(const Vector3& direction) const {
  const Vector3 e = direction.normalized();
  const double along = e.dot(spread * e);
  return std::sqrt(2.0 * along / (spread.trace() - along));
}

VolumeMoments volume_moments(const Surface& s) {
  // Relative to the mean of the surface, so that nothing cancels far from the origin.
  const Vector3 mean = centroid(s);
  const Matrix y = s.position.rowwise() - mean.transpose();
  // y and y yᵀ are homogeneous of degree 1 and 2: their volume integrals are fluxes of y f over 4 and 5.
  const double volume = flux_integral(s, y, Matrix::Ones(y.rows(), 1))[0] / 3.0;
  const Vector3 offset = flux_integral(s, y, y).transpose() / (4.0 * volume);
  VolumeMoments moments;
  moments.centroid = mean + offset;
  for (int i = 0; i < 3; ++i) {
    const Matrix products = y.col(i).asDiagonal() * y;
    moments.spread.row(i) = flux_integral(s, y, products) / (5.0 * volume);
  }
  moments.spread -= offset * offset.transpose();
  return moments;
}

Vector3 centroid_velocity(const Surface& s, const VolumeMoments& moments, const Matrix& velocity) {
  const Matrix y = s.position.rowwise() - moments.centroid.transpose();
  return flux_integral(s, velocity, y).transpose() / enclosed_volume(s);
}

Turning turning(const Surface& s, const VolumeMoments& moments, const Matrix& relative_velocity, const Vector3& axis) {
  // Two directions that form a right-handed system with the axis.
  Eigen::Matrix<double, 3, 2> across;
  const bool along_x = std::abs(axis.x()) > 0.9 * axis.norm();
  across.col(1) = axis.cross(along_x ? Vector3::UnitZ() : Vector3::UnitX()).normalized();
  across.col(0) = across.col(1).cross(axis.normalized());
  const Matrix y = (s.position.rowwise() - moments.centroid.transpose()) * across;

  // tan 2ψ = 2 G₁₂/(G₁₁ − G₂₂) of the second moments G of the volume, dG/dt = ∫ (v·n) y yᵀ dA.
  const Eigen::Matrix2d spread = across.transpose() * moments.spread * across;
  Eigen::Matrix2d rate;
  for (int i = 0; i < 2; ++i) {
    rate.row(i) = flux_integral(s, relative_velocity, y.col(i).asDiagonal() * y) / enclosed_volume(s);
  }
  const double difference = spread(0, 0) - spread(1, 1), product = 2.0 * spread(0, 1);
  const double length = std::hypot(difference, product);
  constexpr double rounding = 1e-9;
  const bool is_round = length <= rounding * spread.trace();
  const double turned =
      is_round ? 0.0 : (difference * rate(0, 1) - product * 0.5 * (rate(0, 0) - rate(1, 1))) / (length * length);

  const Matrix weighted = s.quadrature.asDiagonal() * y;
  Eigen::Matrix2d fit = ((relative_velocity * across).transpose() * weighted) * (y.transpose() * weighted).inverse();
  fit(0, 1) += turned;
  fit(1, 0) -= turned;
  const double square = fit.determinant() - 0.25 * fit.trace() * fit.trace();
  const double around = std::copysign(std::sqrt(std::max(square, 0.0)), fit(1, 0) - fit(0, 1));
  constexpr double whole = 2.0 * std::numbers::pi;
  return {is_round ? 0.0 : 0.5 * std::atan2(product, difference), turned / whole, around / whole};
}

std::array<double, 5> shape_modes(const Surface& s, const Vector3& centre, const Vector3& axis) {
  const Matrix y = s.position.rowwise() - centre.transpose();
  const Vector r = y.rowwise().norm();
  const Vector cosine = (y * axis.normalized()).cwiseQuotient(r);
  // r dΩ
  const Vector weight =
      y.cwiseProduct(s.normal).rowwise().sum().cwiseProduct(s.quadrature).cwiseQuotient(r.cwiseAbs2());
  std::array<double, 5> modes{};
  for (unsigned l = 2; l < 2 + modes.size(); ++l) {
    const Vector legendre = cosine.unaryExpr([l](double c) { return std::legendre(l, std::clamp(c, -1.0, 1.0)); });
    modes[l - 2] = (2.0 * l + 1.0) * weight.dot(legendre) / weight.sum();
  }
  return modes;
}

}  // namespace vehd
