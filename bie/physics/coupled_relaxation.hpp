#pragma once

#include <vector>

#include "bie/physics/charge_relaxation.hpp"
#include "bie/physics/coupled_electric.hpp"

namespace vehd {

/// field_of_charges of all membranes together: with E_k of every membrane b in terms of its own V_b and charges,
///   ½(E_i + E_e)_a + Σ_b S′_ab[(E_e − E_i)_b] − Σ_b D′_ab[V_b] = E·n on every membrane a.
/// @param start  first guesses of V
/// @returns      each with the report of all; traces of membranes of other ranks, see Interaction, are empty
/// Accuracy: spectral; forces between two spheres at a gap of half a radius to 1e-7 at p = 16
/// (tests/physics/coupled_relaxation_test.cpp)
/// Source: docs/theory/electric.md, the layers being those of all membranes
std::vector<RelaxingField> fields_of_charges(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction, const std::vector<FaceCharges>& charges,
                                             double tolerance, std::vector<Vector> start);

/// solve_law for all membranes at once.
/// @param potentials  where the solve starts on input, V of each on output
SolveReport solve_laws(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                       const std::vector<FaceLaw>& laws, double tolerance, std::vector<Vector>& potentials);

/// relax_charges for all membranes at once: the same equations with K_k = σ_k + ε_k/dt and C_m/dt + G_m of each.
/// @param charges  before the step on input, after it on output
/// @param dt       > 0
/// Accuracy: first order in dt, spectral in space; one step of two spheres as their multipoles to 1e-7
/// (tests/physics/coupled_relaxation_test.cpp)
SolveReport relax_charges(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction, double dt,
                          double tolerance, std::vector<FaceCharges>& charges);

}  // namespace vehd
