#pragma once

#include "bie/physics/electric.hpp"

namespace vehd {

/// Free charge on the faces of a membrane, over C_m so that it is a potential: coefficients of degree p. With
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
  SolveReport report;
};

/// Solves (½ + ηS′)(C_m V − q_i) − κ D′[V] = κ (E·n − ½ Q/ε_e − S′[Q/ε_e]), η and κ of the permittivities,
/// Q = q_i + q_e, for V, and with it everything on the membrane.
/// @param start  a first guess of V, or empty
/// Accuracy: spectral; both rates of a sphere to 1e-9 (tests/physics/charge_relaxation_test.cpp)
RelaxingField field_of_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                               const Membrane& membrane, const FaceCharges& charges, double tolerance,
                               const Vector& start = {});

/// Rates of the charges on material points, over C_m: D q_i/Dt = σ_i E_i − G_m V, D q_e/Dt = −σ_e E_e + G_m V. No net
/// current leaves a closed membrane on either side.
FaceCharges charge_rates(const ElectricParameters& electric, const ChargingParameters& charging,
                         const Membrane& membrane, const RelaxingField& field);

/// The charges after one backward-Euler step of these, in one solve for V at the end of the step: with y = C_m/dt + G_m
/// and η, κ of K_k = σ_k + ε_k/dt it obeys
///   (½ + ηS′) yV − κ D′[V] = κ (E·n + (½ − S′)[q_i/(K_i dt)] − (½ + S′)[q_e/(K_e dt)]).
/// @param charges  before the step on input, after it on output
/// @param dt       > 0
/// Accuracy: first order in dt, spectral in space; each step on a sphere is backward Euler to 1e-10
/// (tests/physics/charge_relaxation_test.cpp)
SolveReport relax_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                          const Membrane& membrane, double dt, double tolerance, FaceCharges& charges);

/// The charges of a steady state in which V_m is this: σ_k E_k = G_m V.
/// @throws InputError where a fluid insulates
FaceCharges steady_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                           const Vector& potential);

}  // namespace vehd
