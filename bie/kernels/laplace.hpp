#pragma once

#include <numbers>

/// Pointwise Laplace kernels, r = x − y (target minus source). No quadrature, no area element.
namespace vehd {

/// Prefactor of G = 1/(4π|r|) and of its derivatives.
constexpr double kLaplacePrefactor = 1.0 / (4.0 * std::numbers::pi);

/// |r| G / prefactor-free parts: single layer 1/|r|.
inline double laplace_single_kernel(double inverse_r) { return inverse_r; }

/// ∂G/∂n(y) without prefactor: r·n(y)/|r|³, Eq. (9).
inline double laplace_double_kernel(double r_dot_source_normal, double inverse_r) {
  return r_dot_source_normal * inverse_r * inverse_r * inverse_r;
}

/// ∂G/∂n(x) without prefactor: −r·n(x)/|r|³.
inline double laplace_adjoint_kernel(double r_dot_target_normal, double inverse_r) {
  return -r_dot_target_normal * inverse_r * inverse_r * inverse_r;
}

}  // namespace vehd
