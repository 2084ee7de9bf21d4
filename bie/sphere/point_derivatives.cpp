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

std::vector<PointDerivatives> point_derivatives(const Matrix& coefficients, const std::vector<SpherePoint>& points) {
  const int order = order_of(coefficients.rows());
  const Index n_points = static_cast<Index>(points.size()), n_fields = coefficients.cols();
  Vector theta(n_points);
  Eigen::ArrayXd phi(n_points);
  for (Index i = 0; i < n_points; ++i) {
    theta[i] = points[static_cast<std::size_t>(i)].theta;
    phi[i] = points[static_cast<std::size_t>(i)].phi;
  }
  const LegendreTables tables = legendre_tables(order, theta);
  Matrix value = Matrix::Zero(n_points, n_fields), d1 = value, d2 = value, d11 = value, d12 = value, laplacian = value;
  Matrix factors, scaled, amplitudes;
  for (int m = 0; m <= order; ++m) {
    const Vector cosine = (m * phi).cos(), sine = (m * phi).sin();
    factors.setZero(order + 1 - m, 2 * n_fields);  // of cos mφ, then of sin mφ
    for (int n = m; n <= order; ++n) {
      factors.row(n - m).head(n_fields) = coefficients.row(coefficient_index(n, m));
      if (m > 0) factors.row(n - m).tail(n_fields) = coefficients.row(coefficient_index(n, -m));
    }
    scaled = factors;
    for (int n = m; n <= order; ++n) scaled.row(n - m) *= -double(n) * (n + 1);
    const auto add_even = [&](const Matrix& table, const Matrix& of, Matrix& sum) {
      amplitudes.noalias() = table * of;
      sum += cosine.asDiagonal() * amplitudes.leftCols(n_fields);
      sum += sine.asDiagonal() * amplitudes.rightCols(n_fields);
    };
    const auto add_odd = [&](const Matrix& table, Matrix& sum) {
      amplitudes.noalias() = table * factors;
      sum += cosine.asDiagonal() * amplitudes.rightCols(n_fields);
      sum -= sine.asDiagonal() * amplitudes.leftCols(n_fields);
    };
    add_even(tables.value[m], factors, value);
    add_even(tables.value[m], scaled, laplacian);
    add_even(tables.d_theta[m], factors, d1);
    add_even(tables.d2_theta[m], factors, d11);
    if (m > 0) {
      add_odd(tables.m_over_sin[m], d2);
      add_odd(tables.d_m_over_sin[m], d12);
    }
  }
  std::vector<PointDerivatives> result;
  for (Index i = 0; i < n_points; ++i) {
    result.push_back({value.row(i), d1.row(i), d2.row(i), d11.row(i), d12.row(i), laplacian.row(i) - d11.row(i)});
  }
  return result;
}

}  // namespace vehd
