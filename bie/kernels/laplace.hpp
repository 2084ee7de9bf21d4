#pragma once

#include <numbers>

/// Pointwise Laplace kernels, r = x − y (target minus source). No quadrature, no area element. Real is a number or an
/// array with one number for each of several nodes.
namespace vehd {

/// Prefactor of G = 1/(4π|r|) and of its derivatives.
/// Source: paper Eq. (9)
constexpr double kLaplacePrefactor = 1.0 / (4.0 * std::numbers::pi);

/// G without prefactor: 1/|r|, for a target that is not the source.
/// @param inverse_r  1/|r|
/// Accuracy: rounding
/// Source: paper Eq. (9)
template <class Real>
Real laplace_single_kernel(const Real& inverse_r) {
  return inverse_r;
}

/// ∂G/∂n(y) without prefactor: r·n(y)/|r|³, Eq. (9).
/// @param r_dot_source_normal  r·n(y), or r·J n(y) to include the area element, with its unit, in the kernel
/// Accuracy: rounding
/// Source: paper Eq. (9)
template <class Real>
Real laplace_double_kernel(const Real& r_dot_source_normal, const Real& inverse_r) {
  return r_dot_source_normal * inverse_r * inverse_r * inverse_r;
}

/// ∂G/∂n(x) without prefactor: −r·n(x)/|r|³.
/// @param r_dot_target_normal  r·n(x), or r·J n(x)
/// Accuracy: rounding
/// Source: paper Eq. (10), first part
template <class Real>
Real laplace_adjoint_kernel(const Real& r_dot_target_normal, const Real& inverse_r) {
  return -r_dot_target_normal * inverse_r * inverse_r * inverse_r;
}

/// ∂²G/∂n(x)∂n(y) without prefactor: n(x)·n(y)/|r|³ − 3 r·n(x) r·n(y)/|r|⁵; either n may be replaced by J n.
/// @param normals  n(x)·n(y)
/// Accuracy: rounding
/// Source: paper Eq. (10), second part
template <class Real>
Real laplace_hypersingular_kernel(const Real& normals, const Real& r_dot_target_normal, const Real& r_dot_source_normal,
                                  const Real& inverse_r) {
  const Real inverse_square = inverse_r * inverse_r;
  return (normals - 3.0 * r_dot_target_normal * r_dot_source_normal * inverse_square) * inverse_square * inverse_r;
}

}  // namespace vehd
