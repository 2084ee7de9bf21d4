#pragma once

#include <array>
#include <numbers>

/// Pointwise Stokes kernels, r = x − y (target minus source). No quadrature, no area element. Real is a number or an
/// array with one number for each of several nodes.
namespace vehd {

/// 1/(8πμ).
/// @param viscosity  μ > 0
/// Source: paper Eq. (6)
constexpr double stokes_single_layer_prefactor(double viscosity) { return 1.0 / (8.0 * std::numbers::pi * viscosity); }

/// Index of the entry (i, j) of a symmetric kernel in its upper triangle xx, xy, xz, yy, yz, zz.
constexpr int kStokesBlock[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};

/// Upper triangle xx, xy, xz, yy, yz, zz of δ_ij/|r| + r_i r_j/|r|³, Eq. (6) without prefactor.
/// @param inverse_r  1/|r|
/// Accuracy: rounding; its single layer has the eigenvalues of the sphere to 1e-11
/// (tests/potentials/stokes_sphere_test.cpp)
/// Source: paper Eq. (6)
template <class Real>
std::array<Real, 6> stokeslet(const Real& rx, const Real& ry, const Real& rz, const Real& inverse_r) {
  const Real inverse_r3 = inverse_r * inverse_r * inverse_r;
  return {inverse_r + rx * rx * inverse_r3, rx * ry * inverse_r3, rx * rz * inverse_r3,
          inverse_r + ry * ry * inverse_r3, ry * rz * inverse_r3, inverse_r + rz * rz * inverse_r3};
}

/// The Stokeslet times a force, f/|r| + r r·f/|r|³, in half the operations.
/// Source: paper Eq. (6)
template <class Real>
std::array<Real, 3> stokeslet_flow(const Real& rx, const Real& ry, const Real& rz, const Real& inverse_r,
                                   const Real& fx, const Real& fy, const Real& fz) {
  const Real along = (rx * fx + ry * fy + rz * fz) * (inverse_r * inverse_r);
  return {inverse_r * (fx + along * rx), inverse_r * (fy + along * ry), inverse_r * (fz + along * rz)};
}

/// Prefactor 3/(4π) of the Stokes double layer; the viscosity does not enter.
constexpr double kStokesDoubleLayerPrefactor = 3.0 / (4.0 * std::numbers::pi);

/// Upper triangle xx, xy, xz, yy, yz, zz of r_i r_j (r·n(y))/|r|⁵ without prefactor: the stress −3/(4π) r_i r_j
/// r_k/|r|⁵ of a Stokeslet, applied to the normal at the source and with the opposite sign, so that the layer obeys the
/// same jumps as the Laplace double layer. For a rigid motion v = a + b × y
///   D[v] = −v inside, −½ v on the surface (principal value), 0 outside,
/// and D[v] of any v jumps by −v from outside to inside. A flow with velocity u and traction t = σ·n on the surface has
///   u = S[t]/μ − D[u] inside (½u on the surface), or u = D[u] − S[t]/μ outside if it decays.
/// As r·n(y) = O(|r|²) for smooth surfaces, the kernel is O(1/|r|).
/// @param r_dot_source_normal  r·n(y), or r·J n(y)
/// @param inverse_r            1/|r|
/// Accuracy: rounding; its double layer has the eigenvalues of the sphere to 1e-11
/// (tests/potentials/stokes_sphere_test.cpp)
/// Source: Pozrikidis 1992
template <class Real>
std::array<Real, 6> stokes_double_kernel(const Real& rx, const Real& ry, const Real& rz,
                                         const Real& r_dot_source_normal, const Real& inverse_r) {
  const Real inverse_r2 = inverse_r * inverse_r;
  const Real factor = r_dot_source_normal * inverse_r2 * inverse_r2 * inverse_r;
  const Real x = factor * rx;
  const Real y = factor * ry;
  const Real z = factor * rz;
  return {x * rx, x * ry, x * rz, y * ry, y * rz, z * rz};
}

/// stokes_double_kernel times a velocity: r r·v r·n(y)/|r|⁵.
/// Source: Pozrikidis 1992
template <class Real>
std::array<Real, 3> stokes_double_flow(const Real& rx, const Real& ry, const Real& rz, const Real& r_dot_source_normal,
                                       const Real& inverse_r, const Real& vx, const Real& vy, const Real& vz) {
  const Real inverse_r2 = inverse_r * inverse_r;
  const Real along = (rx * vx + ry * vy + rz * vz) * (r_dot_source_normal * inverse_r2) * (inverse_r2 * inverse_r);
  return {along * rx, along * ry, along * rz};
}

}  // namespace vehd
