#pragma once

#include "bie/linear/solve_report.hpp"
#include "bie/physics/effect.hpp"
#include "bie/physics/membrane.hpp"
#include "bie/physics/parameters.hpp"

namespace vehd {

/// One membrane in a field. Of several the parameters outside are those of all.
struct ElectricMembrane {
  ElectricParameters electric;
  const Membrane& membrane;
};

/// (σ_i − σ_e)/(σ_i + σ_e), Eq. (11).
/// In [−1, 1]; conductivities in one unit.
double conductivity_contrast(const ElectricParameters& electric);
/// σ_i σ_e/(σ_i + σ_e), the prefactor of Eq. (14).
/// Source: paper Eqs. (14), (29)
double series_conductivity(const ElectricParameters& electric);
/// Is q other than zero anywhere? Not between fluids of equal conductivity, and of equal permittivity where that counts
/// in an averaged field. Charge that relaxes in time may be anything.
bool carries_charge(const ElectricParameters& electric);

/// (½ + η S′) on weighted coefficients: J g ↦ J (½ g + η S′[g]); the left side of Eq. (12). Its entry of degree 0 is
/// ½(1 − η) times that of J g exactly (∫S′[g] = −½∫g), also where the quadrature would only come close.
/// @param weighted_density  coefficients of J g, [n_coefficients]
/// Source: paper Eq. (12), divided by η
Vector second_kind_operator(const Membrane& membrane, double eta, const Vector& weighted_density);

/// Inverse of second_kind_operator on a sphere of any radius, the preconditioner of Eq. (12).
Vector second_kind_sphere_inverse(double eta, const Vector& weighted);

/// Coefficients of a right-hand side of Eq. (12) on which second_kind_operator can act: a mean that is rounding is
/// zero.
/// @param weighted_values  J rhs on the upsampled grid
Vector second_kind_right_side(const Membrane& membrane, const Vector& weighted_values);

/// J D′[V] of Eq. (24): J (n×∇_γ)·S[n×∇_γ V], values on the upsampled grid. Both rotated gradients are formed without
/// dividing by J: J n×∇_γ f = f_1 x_2 − f_2 x_1.
/// @param potential  coefficients of V, [n_coefficients]
/// Accuracy: spectral; eigenvalues −n(n+1)/(2n+1) of the unit sphere to 1e-11 (tests/physics/hypersingular_test.cpp)
/// Source: paper Eqs. (24)–(26)
Vector weighted_hypersingular(const Membrane& membrane, const Vector& potential);

/// J E·n, values on the upsampled grid.
/// Source: right-hand side of paper Eq. (12)
Vector weighted_field_flux(const Membrane& membrane, const Vector3& field);

/// Solution of (½ + ηS′) g = rhs.
struct SecondKindSolution {
  Vector weighted;  ///< coefficients of J g, the unknown of the solve
  Vector values;    ///< g on the upsampled grid
  SolveReport report;
};

/// Solves (½ + ηS′) g = rhs. A right-hand side of zero mean gives a density of zero mean at every contrast, also η = 1.
/// The values come from g = 2 (rhs − ηS′[g]) with the solved density on the right: S′ smooths, so they are free of the
/// truncation to degree p that the coefficients of g suffer.
/// @param weighted_rhs  J rhs on the upsampled grid
/// @param start         coefficients of J g to start from, or empty
/// @param tolerance     of the preconditioned residual, relative
/// Accuracy: that of the layers; on the sphere to 1e-11 at every ratio of conductivities
/// (tests/physics/electric_sphere_test.cpp), uniform field inside a 2:1 prolate to 1e-10
/// (tests/physics/electric_prolate_test.cpp); at most 15 iterations on shape (33)
/// (tests/physics/electric_solver_test.cpp)
/// Source: paper Eq. (12)
SecondKindSolution solve_second_kind(const Membrane& membrane, double eta, const Vector& weighted_rhs, double tolerance,
                                     const Vector& start);

/// Traces of the potential and of its normal derivative on both sides, on the upsampled grid.
struct ElectricTraces {
  Vector potential_in, potential_out;  ///< coefficients of degree p of φ_i, φ_e, Eq. (11a, b)
  Vector flux_in, flux_out;            ///< ∂φ_i/∂n, ∂φ_e/∂n, values on the upsampled grid
  Vector charge;                       ///< q = [[∂φ/∂n]], values on the upsampled grid
};

/// @param density  g with (½ + ηS′) g = E·n + D′[V]; the fluxes follow as −σ_e g/(σ_i+σ_e) and −σ_i g/(σ_i+σ_e),
///                 the regular form of Eq. (13)
/// @param potential  V_m, coefficients of degree p
/// @param of_others  potential of the charges and V_m of other membranes on this one, coefficients, or empty
/// Accuracy: that of the density; σ_i ∂φ_i/∂n = σ_e ∂φ_e/∂n to 1e-14 at every ratio
/// (tests/physics/electric_sphere_test.cpp)
/// Source: paper Eqs. (11), (13)
ElectricTraces electric_traces(const ElectricParameters& electric, const Membrane& membrane, const Vector& potential,
                               const SecondKindSolution& density, const Vector& of_others = {});

/// f_E = [[n·Σ_el]] (interior minus exterior), Eqs. (3), (15), (32), on the upsampled grid.
/// @param permittivity        outside
/// @param permittivity_ratio  inside over outside
/// @return  minus the force per area of the field on the membrane, normal and tangential part, [n_points x 3]; the
/// fluid
///     feels f_b + f_λ − f_E
/// Accuracy: spectral; on the sphere to 1e-11 (tests/physics/electric_sphere_test.cpp); errors of Example 1 as the
/// paper has them (tests/physics/example1_test.cpp)
/// Source: paper Eqs. (3), (15), (32); Melcher and Taylor 1969
Matrix electric_force(double permittivity, const Membrane& membrane, const ElectricTraces& traces,
                      double permittivity_ratio = 1.0);

/// What the electric problem asks of a step, charging included.
EffectDescription electric_description(const ElectricParameters& electric);

}  // namespace vehd
