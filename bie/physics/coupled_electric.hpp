#pragma once

#include <vector>

#include "bie/physics/electric.hpp"
#include "bie/physics/interaction.hpp"

namespace vehd {

/// Which layers of this membrane the electric problem of the others needs.
PairSelection electric_pair_selection(const ElectricParameters& electric);

/// J (E·n + Σ_b D′_ab[V_b]) for every membrane a of this rank, values on its upsampled grid.
/// @param potentials  coefficients of each V_b
/// Source: right-hand side of paper Eq. (12) with the potentials of all membranes
std::vector<Vector> weighted_fluxes(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                    const std::vector<Vector>& potentials);

/// Solution of ½ g_a + Σ_b η_b S′_ab[g_b] = rhs_a.
struct CoupledDensities {
  std::vector<SecondKindSolution> membranes;  ///< each with the report of all
  SolveReport report;
};

/// Solves for the densities of all membranes together, as solve_second_kind does for one: each right-hand side of zero
/// mean gives a density of zero mean. Preconditioned with the sphere's inverse on each membrane; the unknowns are
/// J g/R², so that small membranes count like large ones.
/// @param weighted_rhs  J rhs on the upsampled grid of each of this rank; likewise the values of the densities, whose
///     coefficients are those of all
/// Accuracy: forces between two spheres along and across the field, insulating and conducting, at a gap of half a
/// radius to 1e-9 at p = 20 (tests/physics/coupled_electric_test.cpp)
///
/// Source: paper Eq. (12), the layers being those of all membranes
CoupledDensities solve_second_kind(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                   const std::vector<Vector>& weighted_rhs, double tolerance);

/// What charges and V_m of all other membranes make of the potential on each of this rank: Σ_{b≠a} S_ab[q_b] −
/// D_ab[V_b], coefficients; for electric_traces.
///
/// Source: paper Eq. (7)
std::vector<Vector> potentials_of_others(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                         const std::vector<Vector>& potentials,
                                         const std::vector<SecondKindSolution>& densities);

}  // namespace vehd
