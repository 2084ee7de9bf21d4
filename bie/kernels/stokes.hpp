#pragma once

#include <array>
#include <numbers>

/// Pointwise Stokes kernels, r = x − y (target minus source). No quadrature, no area element.
namespace vehd {

/// 1/(8πμ), Eq. (6).
constexpr double stokes_single_layer_prefactor(double viscosity) { return 1.0 / (8.0 * std::numbers::pi * viscosity); }

/// Upper triangle xx, xy, xz, yy, yz, zz of δ_ij/|r| + r_i r_j/|r|³, Eq. (6) without prefactor.
inline std::array<double, 6> stokeslet(double rx, double ry, double rz, double inverse_r) {
  const double inverse_r3 = inverse_r * inverse_r * inverse_r;
  return {inverse_r + rx * rx * inverse_r3, rx * ry * inverse_r3, rx * rz * inverse_r3,
          inverse_r + ry * ry * inverse_r3, ry * rz * inverse_r3, inverse_r + rz * rz * inverse_r3};
}

}  // namespace vehd
