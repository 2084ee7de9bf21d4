#pragma once

#include <vector>

#include "bie/physics/electric.hpp"
#include "bie/physics/interaction.hpp"

namespace vehd {

/// Which layers of this membrane the electric problem of the others needs.
PairSelection electric_pair_selection(const ElectricParameters& electric);

/// J (E·n + Σ_b D′_ab[V_b]) for every membrane a of this rank, values on its upsampled grid, [n_points].
/// @param potentials  coefficients of each V_b, [n_coefficients]
/// Source: right-hand side of paper Eq. (12) with the potentials of all membranes
std::vector<Vector> weighted_fluxes(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                    const std::vector<Vector>& potentials);

/// Solves ½ g_a + Σ_b η_b S′_ab[g_b] = rhs_a for the densities of all membranes. A right-hand side of zero mean gives a
/// density of zero mean at every contrast, also η = 1. Preconditioned with the inverse on a sphere; the unknowns are
/// J g/R², so that small membranes count like large ones. The values come from g = 2 (rhs − ηS′[g]) with the solved
/// densities on the right: S′ smooths, so they are free of the truncation to degree p that the coefficients suffer.
/// @param weighted_rhs  J rhs on the upsampled grid of each membrane of this rank, [n_points]
/// @param tolerance     of the preconditioned residual, relative
/// @return  the densities of all, their values on this rank alone; each with the report of the solve
/// Accuracy: that of the layers; on the sphere to 1e-11 at every ratio of conductivities
/// (tests/physics/electric_sphere_test.cpp), uniform field inside a 2:1 prolate to 1e-10
/// (tests/physics/electric_prolate_test.cpp); at most 15 iterations on shape (33)
/// (tests/physics/electric_solver_test.cpp); forces between two spheres along and across the field, insulating and
/// conducting, at a gap of half a radius to 1e-9 at p = 20 (tests/physics/charge_density_test.cpp)
/// Source: paper Eq. (12), the layers being those of all membranes
std::vector<SecondKindSolution> solve_second_kind(const std::vector<ElectricMembrane>& membranes,
                                                  const Interaction& interaction,
                                                  const std::vector<Vector>& weighted_rhs, double tolerance);

/// The density of one membrane alone, with a given η; weighted_rhs as above, [n_points].
SecondKindSolution solve_second_kind(const Membrane& membrane, double eta, const Vector& weighted_rhs,
                                     double tolerance);

/// Σ_{b≠a} S_ab[q_b] − D_ab[V_b], the potential of the charges and V_m of all other membranes on each of this rank,
/// coefficients [n_coefficients], for electric_traces; empty where there are no others.
/// @param potentials  coefficients of each V_b, [n_coefficients]
/// Source: paper Eq. (7)
std::vector<Vector> potentials_of_others(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                         const std::vector<Vector>& potentials,
                                         const std::vector<SecondKindSolution>& densities);

}  // namespace vehd
