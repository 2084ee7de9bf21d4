#pragma once

#include <vector>

#include "bie/physics/current_law.hpp"

namespace vehd {

/// Free charge on the faces of a membrane, over the C_m of its parameters so that it is a potential (where C_m differs
/// from place to place they are charges all the same, over one number): coefficients of degree p. With
/// E_k = −∂φ_k/∂n the inner face has q_i = C_m V − ε_i E_i, the outer one q_e = ε_e E_e − C_m V. Both are continuous in
/// time where the field jumps and V is not; without displacement currents in the fluids q_i would be C_m V.
struct FaceCharges {
  Vector inner;  ///< q_i/C_m
  Vector sum;    ///< (q_i + q_e)/C_m
};

/// The electric state that belongs to charges of the faces and a field.
struct RelaxingField {
  Vector potential;       ///< V_m, coefficients
  ElectricTraces traces;  ///< the charge in them is [[∂φ/∂n]], no free charge
  SolveReport report;     ///< that of all membranes
};

/// What the charges say of both fields: a = C_m, k = ε, s_i = q_i and s_e = q_e.
CurrentLaw law_of_charges(const ChargingMembrane& of, const FaceCharges& charges);
/// One step of backward Euler from these charges with a current G V + J through the membrane: a = C_m/dt + G,
/// k = σ + ε/dt, s_i = q_i/dt − J and s_e = q_e/dt + J.
CurrentLaw law_of_step(const ChargingMembrane& of, const MembraneCurrent& current, double dt,
                       const FaceCharges& charges);
/// The charges at the end of a step that ends in V.
/// @param law  of the step
FaceCharges charges_after(const ChargingMembrane& of, const CurrentLaw& law, const Vector& potential);

/// Solves (½ + ηS′)(C_m V − q_i) − κ D′[V] = κ (E·n − ½ Q/ε_e − S′[Q/ε_e]), η and κ of the permittivities,
/// Q = q_i + q_e, for V, of several membranes with the layers of all, and with it everything on them.
/// @param interaction  of the membranes; null where there is one
/// @param start        first guesses of V; empty ones are zero
/// @returns            traces of membranes of other ranks, see Interaction, are empty
/// Accuracy: spectral; both rates of a sphere to 1e-9 (tests/physics/charge_relaxation_test.cpp), forces between two
/// spheres at a gap of half a radius to 1e-7 at p = 16 (tests/physics/coupled_relaxation_test.cpp)
/// Source: docs/theory/electric.md
std::vector<RelaxingField> fields_of_charges(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction* interaction, const std::vector<FaceCharges>& charges,
                                             double tolerance, std::vector<Vector> start);

/// Rates of the charges on material points, over C_m: D q_i/Dt = σ_i E_i − I, D q_e/Dt = −σ_e E_e + I with the current
/// I through the membrane. No net current leaves a closed membrane on either side.
/// @param current  outwards, values on the upsampled grid
FaceCharges charge_rates(const ChargingMembrane& of, const RelaxingField& field, const Vector& current);

/// The charges after one backward-Euler step of these, in one solve for V at the end of the step: with y = C_m/dt + G_m
/// and η, κ of K_k = σ_k + ε_k/dt it obeys, of one membrane,
///   (½ + ηS′) yV − κ D′[V] = κ (E·n + (½ − S′)[q_i/(K_i dt)] − (½ + S′)[q_e/(K_e dt)]).
/// @param interaction  of the membranes; null where there is one
/// @param charges      before the step on input, after it on output
/// @param dt           > 0
/// Accuracy: first order in dt, spectral in space; each step on a sphere is backward Euler to 1e-10
/// (tests/physics/charge_relaxation_test.cpp), one of two spheres as their multipoles say to 1e-7
/// (tests/physics/coupled_relaxation_test.cpp)
SolveReport relax_charges(const std::vector<ChargingMembrane>& membranes, const Interaction* interaction, double dt,
                          double tolerance, std::vector<FaceCharges>& charges);

/// The charges of a steady state in which V_m is this: σ_k E_k = G_m V + J_p.
/// @throws InputError where a fluid insulates
FaceCharges steady_charges(const ChargingMembrane& of, const Vector& potential);

}  // namespace vehd
