#pragma once

#include <vector>

#include "bie/physics/membrane_charging.hpp"

namespace vehd {

/// The electric state that belongs to charges of the faces and a field.
struct RelaxingField {
  Vector potential;       ///< V_m, coefficients
  ElectricTraces traces;  ///< the charge in them is [[∂φ/∂n]], no free charge
  SolveReport report;     ///< that of all membranes
};

/// Solves (½ + ηS′)(C_m V − q_i) − κ D′[V] = κ (E·n − ½ Q/ε_e − S′[Q/ε_e]), η and κ of the permittivities,
/// Q = q_i + q_e, for V, of several membranes with the layers of all, and with it everything on them.
/// @param start  first guesses of V; empty ones are zero
/// @returns      traces of membranes of other ranks, see Interaction, are empty
/// Accuracy: spectral; both rates of a sphere to 1e-9 (tests/physics/charge_relaxation_test.cpp), forces between two
/// spheres at a gap of half a radius to 1e-7 at p = 16 (tests/physics/coupled_relaxation_test.cpp)
/// Source: docs/theory/electric.md
std::vector<RelaxingField> fields_of_charges(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction, const std::vector<Unknowns>& charges,
                                             double tolerance, std::vector<Vector> start);

/// Rates of the charges on material points, over C_m: D q_i/Dt = σ_i E_i − I, D q_e/Dt = −σ_e E_e + I with the current
/// I through the membrane. No net current leaves a closed membrane on either side.
/// @param current  outwards, values on the upsampled grid
Unknowns charge_rates(const ChargingMembrane& of, const RelaxingField& field, const Vector& current);

}  // namespace vehd
