#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bie/physics/wall.hpp"
#include "bie/potentials/off_surface.hpp"

namespace vehd {

/// Sources of the potential off the membrane: coefficients of degree p; an empty one is zero.
struct PotentialSources {
  Vector3 field = Vector3::Zero();  ///< E_∞
  Vector transmembrane_potential;   ///< V_m
  Vector weighted_charge;           ///< J q, q = [[∂φ/∂n]] = η g
  std::optional<Wall> wall{};       ///< in which both layers have images
};

/// The potential and its field at points off the membrane.
struct PotentialSamples {
  Vector potential;        ///< φ, [n_points]
  Matrix field;            ///< E = −∇φ, [n_points x 3]
  std::vector<Side> side;  ///< of the membrane on which each point lies
  Vector distance;         ///< from the membrane, see OffSurfaceValues
};

/// φ(x) = −E_∞·x + S[q](x) − D[V_m](x), Eq. (11) off the membrane: φ jumps there by V_m, ∂φ/∂n by q (interior minus
/// exterior), and φ → −E_∞·x far away.
/// @param position  coefficients of the membrane, [n_coefficients x 3]
/// @param points    [n_points x 3], inside and outside at any distance, on the fluid's side of a wall
/// @param side      limit taken at points on the membrane; the principal value is the mean of both limits
/// @throws ConvergenceError if the quadrature is not resolved at some point
/// Accuracy: docs/near_membrane.md; potential and field around a sphere to 1e-9, inside a 2:1 prolate to 1e-8
/// (tests/physics/volume_fields_test.cpp)
/// Source: paper Eq. (7)
PotentialSamples potential_at(const Matrix& points, Side side, const Matrix& position, const PotentialSources& sources,
                              const OffSurfaceSettings& settings, Instruments& instruments);

/// Sources of the velocity off the membrane; an empty force is zero.
struct VelocitySources {
  double viscosity = 1.0;                             ///< μ of the outside
  std::function<Vector3(const Vector3&)> background;  ///< v_∞ at a point; empty in a quiescent fluid
  Matrix weighted_force;         ///< J f, f = f_b + f_λ − f_E acting on the fluid, coefficients [n_coefficients x 3]
  double viscosity_ratio = 1.0;  ///< inside over outside, > 0
  Matrix membrane_velocity;      ///< v on γ, coefficients [n_coefficients x 3]; used only if the ratio is not 1
  std::optional<Wall> wall{};    ///< in which both layers have images
};

/// The velocity at points off the membrane.
struct VelocitySamples {
  Matrix velocity;  ///< [n_points x 3]
  std::vector<Side> side;
  Vector distance;
};

/// v(x) = w(x) outside and w(x)/Λ inside, Λ the ratio of the viscosities, with
///   w(x) = v_∞(x) + (1/8πμ) ∫ (I/|r| + r rᵀ/|r|³) f dA + (1 − Λ) D[v](x), r = x − y,
/// D the Stokes double layer (stokes_double_kernel); Eq. (5) for Λ = 1. Continuous across the membrane, so that points
/// on it need no side. Errors of w are multiplied by 1/Λ inside, which matters if Λ is small.
/// @throws ConvergenceError if the quadrature is not resolved at some point
/// @throws InputError unless Λ > 0
/// @param points    [n_points x 3], on the fluid's side of a wall
/// @param position  coefficients of the membrane, [n_coefficients x 3]
/// Accuracy: that of the densities at degree p; around a translating sphere to 1e-10, around a 2:1 prolate to 1e-7, a
/// flow common to two fluids to 1e-5 at p = 24 (tests/physics/volume_fields_test.cpp)
///
/// Source: paper Eq. (5); two viscosities: Pozrikidis 1992
VelocitySamples velocity_at(const Matrix& points, const Matrix& position, const VelocitySources& sources,
                            const OffSurfaceSettings& settings, Instruments& instruments);

}  // namespace vehd
