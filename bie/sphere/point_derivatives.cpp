#include "bie/sphere/point_derivatives.hpp"

#include <algorithm>
#include <cmath>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/legendre.hpp"

namespace vehd {

Eigen::Matrix2d PointDerivatives::hessian(Index column) const {
  Eigen::Matrix2d result;
  result << d11[column], d12[column], d12[column], d22[column];
  return result;
}

PointDerivatives point_derivatives(const Matrix& coefficients, const SpherePoint& point, int azimuthal_order) {
  const int order = order_of(coefficients.rows());
  const LegendreTables tables = legendre_tables(order, Vector::Constant(1, point.theta), azimuthal_order);
  const auto zero = Eigen::RowVectorXd::Zero(coefficients.cols());
  PointDerivatives p{zero, zero, zero, zero, zero, zero};
  Eigen::RowVectorXd even(coefficients.cols()), odd(coefficients.cols());
  for (int m = 0; m <= std::min(order, azimuthal_order); ++m) {
    const double cosine = std::cos(m * point.phi);
    const double sine = std::sin(m * point.phi);
    const double b_factor = m > 0 ? 1.0 : 0.0;
    for (int n = m; n <= order; ++n) {
      const auto a = coefficients.row(coefficient_index(n, m));
      const auto b = coefficients.row(coefficient_index(n, -m));
      even = cosine * a + (b_factor * sine) * b;
      odd = (b_factor * cosine) * b - sine * a;
      const double value = tables.value[m](0, n - m);
      const double d11 = tables.d2_theta[m](0, n - m);
      p.value += value * even;
      p.d1 += tables.d_theta[m](0, n - m) * even;
      p.d2 += tables.m_over_sin[m](0, n - m) * odd;
      p.d11 += d11 * even;
      p.d12 += tables.d_m_over_sin[m](0, n - m) * odd;
      p.d22 += (-double(n) * (n + 1) * value - d11) * even;
    }
  }
  return p;
}

PointDerivatives point_derivatives(const Matrix& coefficients, const SpherePoint& point) {
  return point_derivatives(coefficients, point, order_of(coefficients.rows()));
}

}  // namespace vehd
