#pragma once

#include "bie/physics/membrane_charging.hpp"

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
  SolveReport report;
};

/// What the faces of one membrane hold and let through for a V: E_i = (aV − s_i)/k_i, E_e = (aV + s_e)/k_e.
struct FaceLaw {
  double a = 0.0;                  ///< of V, or its largest value
  double k_in = 1.0, k_out = 1.0;  ///< of the fields: what conducts, or is displaced
  Vector s_in, s_out;              ///< coefficients
  Vector varying{};                ///< a on the upsampled grid; empty where it is the same everywhere
};

/// q_i = C_m V − ε_i E_i and q_e = ε_e E_e − C_m V.
FaceLaw law_of_charges(const ChargingMembrane& of, const FaceCharges& charges);
/// One step of backward Euler from these charges, with K_k = σ_k + ε_k/dt.
FaceLaw law_of_step(const ChargingMembrane& of, double dt, const FaceCharges& charges);
/// The same with another current through the membrane.
FaceLaw law_of_step(const ChargingMembrane& of, const MembraneCurrent& current, double dt, const FaceCharges& charges);
/// The same field between fluids of conductivities k_i and k_e.
ElectricParameters conducting(const ElectricParameters& electric, const FaceLaw& law);
/// κ(E·n + ½(s_i/k_i − s_e/k_e) − S′[s_i/k_i + s_e/k_e]) of one membrane by itself, weighted and scaled as the equation
/// is; no net current: degree 0 holds ∫(aV − s_i) dA = 0.
/// @param of_law  conducting(electric, law)
Vector right_side_of(const ElectricParameters& of_law, const Membrane& membrane, const ChargingEquation& equation,
                     const FaceLaw& law);
/// V of one membrane by itself: ½(E_i + E_e) + S′[E_e − E_i] − D′[V] = E·n with both fields in terms of V.
/// @param potential  where the solve starts on input, V on output
SolveReport solve_law(const ElectricMembrane& of, const FaceLaw& law, double tolerance, Vector& potential);
/// The charges at the end of a step that ends in V.
FaceCharges charges_after(const ChargingMembrane& of, const FaceLaw& law, const Vector& potential);

/// E_e − E_i on one membrane by C_m V, coefficients of J times it: the single layer beside V in the potential.
Vector weighted_field_jump(const ChargingMembrane& of, const FaceCharges& charges, const Vector& potential);
/// Traces that go with V and that layer. The mean of both fields is found from the layers, which smooth: free of the
/// truncation that C_m V − q_i would magnify.
/// @param flux_of_others, of_others  J n·∇ of the double layers less the single layers of other membranes, and their
///     potential; coefficients, or empty
ElectricTraces traces_of_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                                 const Membrane& membrane, const FaceCharges& charges, const Vector& potential,
                                 const Vector& weighted_jump, const Vector& flux_of_others = {},
                                 const Vector& of_others = {});

/// Solves (½ + ηS′)(C_m V − q_i) − κ D′[V] = κ (E·n − ½ Q/ε_e − S′[Q/ε_e]), η and κ of the permittivities,
/// Q = q_i + q_e, for V, and with it everything on the membrane.
/// @param start  a first guess of V, or empty
/// Accuracy: spectral; both rates of a sphere to 1e-9 (tests/physics/charge_relaxation_test.cpp)
RelaxingField field_of_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                               const Membrane& membrane, const FaceCharges& charges, double tolerance,
                               const Vector& start = {});

/// Rates of the charges on material points, over C_m: D q_i/Dt = σ_i E_i − I, D q_e/Dt = −σ_e E_e + I with the current
/// I = G_m V + J_p through the membrane. No net current leaves a closed membrane on either side.
FaceCharges charge_rates(const ElectricParameters& electric, const ChargingParameters& charging,
                         const Membrane& membrane, const RelaxingField& field);
/// The same with another current through the membrane.
/// @param current  outwards, coefficients
FaceCharges charge_rates(const ElectricParameters& electric, const ChargingParameters& charging,
                         const Membrane& membrane, const RelaxingField& field, const Vector& current);

/// The charges after one backward-Euler step of these, in one solve for V at the end of the step: with y = C_m/dt + G_m
/// and η, κ of K_k = σ_k + ε_k/dt it obeys
///   (½ + ηS′) yV − κ D′[V] = κ (E·n + (½ − S′)[q_i/(K_i dt)] − (½ + S′)[q_e/(K_e dt)]).
/// @param charges  before the step on input, after it on output
/// @param dt       > 0
/// Accuracy: first order in dt, spectral in space; each step on a sphere is backward Euler to 1e-10
/// (tests/physics/charge_relaxation_test.cpp)
SolveReport relax_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                          const Membrane& membrane, double dt, double tolerance, FaceCharges& charges);

/// The charges of a steady state in which V_m is this: σ_k E_k = G_m V + J_p.
/// @throws InputError where a fluid insulates
FaceCharges steady_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                           const Membrane& membrane, const Vector& potential);

}  // namespace vehd
