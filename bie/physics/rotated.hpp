#pragma once

#include <cmath>

#include "bie/support/types.hpp"

/// Vectors and tensors in rotated coordinates. Symmetries are detected by exact zeros, so entries that are only
/// rounding errors of the rotation are set to zero.
namespace vehd {

namespace detail {

template <typename Derived>
typename Derived::PlainObject without_rounding(const Eigen::MatrixBase<Derived>& values) {
  constexpr double kRounding = 1e-14;
  const double smallest = kRounding * values.cwiseAbs().maxCoeff();
  return values.unaryExpr([=](double value) { return std::abs(value) <= smallest ? 0.0 : value; });
}

}  // namespace detail

/// R v.
/// Accuracy: rounding; entries below 1e-14 of the largest are zero
inline Vector3 rotated_vector(const Matrix3& rotation, const Vector3& v) {
  return detail::without_rounding((rotation * v).eval());
}

/// R A Rᵀ.
/// Accuracy: rounding; entries below 1e-14 of the largest are zero
inline Matrix3 rotated_tensor(const Matrix3& rotation, const Matrix3& a) {
  return detail::without_rounding((rotation * a * rotation.transpose()).eval());
}

}  // namespace vehd
