#pragma once

#include <vector>

#include "bie/linear/solve_report.hpp"
#include "bie/physics/interaction.hpp"
#include "bie/physics/membrane.hpp"
#include "bie/physics/parameters.hpp"
#include "bie/support/complex_columns.hpp"

namespace vehd {

/// One membrane in a field. Several membranes have the same parameters outside.
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
/// Can q be nonzero? Always if charge relaxes in time; otherwise only if the conductivities differ or, in an averaged
/// field with displacement currents, the permittivities.
bool carries_charge(const ElectricParameters& electric);

/// J D′[V] of Eq. (24): J (n×∇_γ)·S[n×∇_γ V], values on the upsampled grid, [n_points]. Both rotated gradients are
/// formed without dividing by J: J n×∇_γ f = f_1 x_2 − f_2 x_1.
/// @param potential  coefficients of V, [n_coefficients]
/// Accuracy: spectral; eigenvalues −n(n+1)/(2n+1) of the unit sphere to 1e-11 (tests/physics/hypersingular_test.cpp)
/// Source: paper Eqs. (24)–(26)
Vector weighted_hypersingular(const Membrane& membrane, const Vector& potential);

/// J E·n, values on the upsampled grid, [n_points].
/// Source: right-hand side of paper Eq. (12)
Vector weighted_field_flux(const Membrane& membrane, const Vector3& field);

/// Solution of (½ + ηS′) g = rhs.
struct SecondKindSolution {
  Vector weighted;  ///< coefficients of J g, the unknown of the solve, [n_coefficients]
  Vector values;    ///< g on the upsampled grid, [n_points]
  SolveReport report;
};

/// Traces of the potential and of its normal derivative on both sides; complex for amplitudes.
template <typename Scalar>
struct TracesOf {
  FieldOf<Scalar> potential_in, potential_out;  ///< coefficients of degree p of φ_i, φ_e, Eq. (11a, b)
  FieldOf<Scalar> flux_in, flux_out;            ///< ∂φ_i/∂n, ∂φ_e/∂n, values on the upsampled grid
  FieldOf<Scalar> charge;                       ///< q = [[∂φ/∂n]], values on the upsampled grid
};

using ElectricTraces = TracesOf<double>;

/// Potentials, fluxes and charge of one membrane.
/// @param density  g with (½ + ηS′) g = E·n + D′[V]; the fluxes follow as −σ_e g/(σ_i+σ_e) and −σ_i g/(σ_i+σ_e),
///                 the regular form of Eq. (13)
/// @param potential  V_m, coefficients [n_coefficients]
/// @param of_others  potential of the charges and V_m of other membranes on this one, coefficients [n_coefficients], or
///                   empty
/// Accuracy: that of the density; σ_i ∂φ_i/∂n = σ_e ∂φ_e/∂n to 1e-14 at every ratio
/// (tests/physics/electric_sphere_test.cpp)
/// Source: paper Eqs. (11), (13)
ElectricTraces electric_traces(const ElectricParameters& electric, const Membrane& membrane, const Vector& potential,
                               const SecondKindSolution& density, const Vector& of_others = {});

/// f_E = [[n·Σ_el]] (interior minus exterior), Eqs. (3), (15), (32), on the upsampled grid.
/// @param permittivity        outside
/// @param permittivity_ratio  inside over outside
/// @return  minus the force per area of the field on the membrane, normal and tangential part, [n_points x 3]; the
///     force on the fluid is f_b + f_λ − f_E
/// Accuracy: spectral; on the sphere to 1e-11 (tests/physics/electric_sphere_test.cpp); errors of Example 1 as in the
/// paper (tests/physics/example1_test.cpp)
/// Source: paper Eqs. (3), (15), (32); Melcher and Taylor 1969
Matrix electric_force(double permittivity, const Membrane& membrane, const ElectricTraces& traces,
                      double permittivity_ratio = 1.0);

/// Layers of this membrane that the electric problem of the others requires.
PairSelection electric_pair_selection(const ElectricParameters& electric);

/// J (E·n + Σ_b D′_ab[V_b]) for every membrane a of this rank, values on its upsampled grid, [n_points].
/// @param potentials  coefficients of each V_b, [n_coefficients]
/// Source: right-hand side of paper Eq. (12) with the potentials of all membranes
std::vector<Vector> weighted_fluxes(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                    const std::vector<Vector>& potentials);

/// Solves ½ g_a + Σ_b η_b S′_ab[g_b] = rhs_a for the densities of all membranes. A right-hand side of zero mean gives a
/// density of zero mean at every contrast, also η = 1. Preconditioned with the inverse on a sphere; the unknowns are
/// J g/R², so that small and large membranes have equal weight. The values are g = 2 (rhs − ηS′[g]) with the solved
/// densities on the right. As S′ smooths, they are not truncated to degree p as the coefficients are.
/// @param weighted_rhs  J rhs on the upsampled grid of each membrane of this rank, [n_points]
/// @param tolerance     of the preconditioned residual, relative
/// @return  densities of all membranes, with values only for those of this rank; each with the report of the solve
/// Accuracy: that of the layers; on the sphere to 1e-11 at every ratio of conductivities
/// (tests/physics/electric_sphere_test.cpp), uniform field inside a 2:1 prolate to 1e-10
/// (tests/physics/electric_prolate_test.cpp); at most 15 iterations on shape (33)
/// (tests/physics/electric_solver_test.cpp); forces between two spheres along and across the field, insulating and
/// conducting, at a gap of half a radius to 1e-9 at p = 20 (tests/physics/charge_density_test.cpp)
/// Source: paper Eq. (12) with the layers of all membranes
std::vector<SecondKindSolution> solve_second_kind(const std::vector<ElectricMembrane>& membranes,
                                                  const Interaction& interaction,
                                                  const std::vector<Vector>& weighted_rhs, double tolerance);

/// The density of a single membrane with a given η; weighted_rhs as above, [n_points].
SecondKindSolution solve_second_kind(const Membrane& membrane, double eta, const Vector& weighted_rhs,
                                     double tolerance);

/// Σ_{b≠a} S_ab[q_b] − D_ab[V_b], the potential of the charges and V_m of all other membranes on each of this rank,
/// coefficients [n_coefficients], for electric_traces; empty without others.
/// @param potentials  coefficients of each V_b, [n_coefficients]
/// Source: paper Eq. (7)
std::vector<Vector> potentials_of_others(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                         const std::vector<Vector>& potentials,
                                         const std::vector<SecondKindSolution>& densities);

}  // namespace vehd
