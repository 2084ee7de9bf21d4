#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <type_traits>

#include "bie/support/types.hpp"

/// Complex numbers as columns of their real and imaginary parts, [n x 2]: amplitudes z of Re(z e^{iωt}).
namespace vehd {

/// c z, [n x 2].
inline Matrix times(std::complex<double> c, const Matrix& z) {
  Eigen::Matrix2d map;
  map << c.real(), c.imag(), -c.imag(), c.real();
  return z * map;
}

/// A field of real or complex numbers.
template <typename Scalar>
using FieldOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// A real field as one column, [n x 1], a complex one as two, [n x 2].
inline Matrix parts_of(const FieldOf<double>& real) { return real; }
inline Matrix parts_of(const FieldOf<std::complex<double>>& z) {
  Matrix parts(z.size(), 2);
  parts << z.real(), z.imag();
  return parts;
}

/// The field [n] with these real and imaginary parts, the inverse of parts_of.
template <typename Scalar>
FieldOf<Scalar> from_parts(const Matrix& parts) {
  if constexpr (std::is_same_v<Scalar, double>) {
    return parts;
  } else {
    return parts.col(0) + std::complex<double>(0.0, 1.0) * parts.col(1);
  }
}

/// |z|, [n].
inline Vector magnitudes(const Matrix& z) { return z.rowwise().norm(); }

/// arg z in degrees, [n]; 0 if |z| is at most 1e-9 of the largest.
inline Vector phases_deg(const Matrix& z) {
  constexpr double kRounding = 1e-9;
  const Vector sizes = magnitudes(z);
  const double least = kRounding * sizes.maxCoeff();
  Vector phases = Vector::Zero(z.rows());
  for (Index i = 0; i < z.rows(); ++i) {
    if (sizes[i] > least) phases[i] = std::atan2(z(i, 1), z(i, 0)) * 180.0 / std::numbers::pi;
  }
  return phases;
}

}  // namespace vehd
