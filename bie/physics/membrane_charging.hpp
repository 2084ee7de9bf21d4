#pragma once

#include <vector>

#include "bie/physics/current_law.hpp"
#include "bie/physics/unknowns.hpp"

namespace vehd {

/// One implicit step of the charging of all membranes and of the state s of those that porate,
///   y − dt F(y) = from,   or with a residual   y − dt F(y) = from + residual − dt F(from),
/// F_qi = σ_i E_i − (G_m + g(s)) V − J_p, F_qe = −σ_e E_e + (G_m + g(s)) V + J_p, F_s = r(s, V); without displacement
/// currents C_m dV_m/dt = σ_i E_i − (G_m + g(s)) V_m − J_p. If no membrane porates, this is one linear solve for V;
/// otherwise Newton's method for V, with s eliminated at every point and one such solve per step. With a = C_m/dt +
/// G_m, b = (C_m/dt) V_m − J_p and κ = σ_i σ_e/(σ_i + σ_e), V of one membrane without displacement currents satisfies
///   (½ + ηS′)(a V − b) − κ D′[V] = κ E·n.
/// @param membranes  with the field and the pump at the end of the step, which a correction ignores
/// @param dt         > 0
/// @param tolerance  of the solves, relative; Newton's method stops when V changes by at most ten times this
/// @param from       charges and s at the start; positions are ignored
/// @param residual   null for a step of backward Euler
/// @param reached    y of each on output, without position
/// @return  iterations of all solves; not converged if Newton's method is not
/// @throws InputError  as solve_laws
/// Accuracy: first order in dt, spectral in space; each step on the sphere is backward Euler to 1e-11, with
/// displacement currents to 1e-10 (tests/physics/charging_test.cpp, tests/physics/charge_relaxation_test.cpp); the
/// multipoles of two spheres charge as their linear system predicts (tests/physics/charge_density_test.cpp), spheres
/// porate as an independent integrator predicts (tests/stepping/poration_steps_test.cpp)
/// Source: paper Eqs. (14), (29), (30), without the inverse
SolveReport charge_membranes(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction, double dt,
                             double tolerance, const std::vector<Unknowns>& from, const std::vector<Unknowns>* residual,
                             std::vector<Unknowns>& reached);

/// s of a membrane that porates after such a step, coefficients [n_coefficients], for a given V at its end.
/// @param from       V and s at the start
/// @param potential  V at the end, coefficients [n_coefficients]
Vector react(const PorationReaction& reaction, const SphereTransform& fine, double dt, const Unknowns& from,
             const Unknowns* residual, const Vector& potential);

/// ds/dt for s and V, all coefficients [n_coefficients].
Vector reaction_rate(const PorationReaction& reaction, const SphereTransform& fine, const Vector& state,
                     const Vector& potential);

/// Steady V_m, the limit of a long step.
/// @param potentials   coefficients [n_coefficients]: first guesses on input, zero if empty; steady V_m on output
/// @throws InputError  if V_m is not determined (a membrane and a fluid that both insulate, or an insulating membrane
///                     with a pump), or as solve_laws
/// Accuracy: spectral; on the sphere to 1e-11 (tests/physics/charging_test.cpp), on an insulating 2:1 prolate to 1e-10
/// (tests/physics/electric_prolate_test.cpp), two spheres act as insulators to 1e-8
/// (tests/physics/charge_density_test.cpp)
/// Source: paper Eq. (14) without its first term
SolveReport steady_potentials(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                              double tolerance, std::vector<Vector>& potentials);

/// The charges of a steady state with a given V_m, coefficients [n_coefficients]: σ_k E_k = G_m V_m + J_p.
/// @throws InputError if there are displacement currents and a fluid insulates
Unknowns steady_charges(const ChargingMembrane& of, const Vector& potential);

/// Electric state for given charges of the faces and applied field.
struct RelaxingField {
  Vector potential;       ///< V_m, coefficients [n_coefficients]
  ElectricTraces traces;  ///< their charge is [[∂φ/∂n]], not the free charge
  SolveReport report;     ///< of the solve for all membranes
};

/// Solves (½ + ηS′)(C_m V − q_i) − κ D′[V] = κ (E·n − ½ Q/ε_e − S′[Q/ε_e]), η and κ of the permittivities,
/// Q = q_i + q_e, for V, with the layers of all membranes, and evaluates the traces.
/// @param start  first guesses of V, coefficients [n_coefficients]; empty ones are zero
/// @returns      state of each membrane; traces are empty for membranes of other ranks, see Interaction
/// Accuracy: spectral; both rates of a sphere to 1e-9 (tests/physics/charge_relaxation_test.cpp), forces between two
/// spheres at a gap of half a radius to 1e-7 at p = 16 (tests/physics/coupled_relaxation_test.cpp)
/// Source: docs/theory/electric.md
std::vector<RelaxingField> fields_of_charges(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction, const std::vector<Unknowns>& charges,
                                             double tolerance, std::vector<Vector> start);

/// A current on a closed membrane, values on the upsampled grid, [n_points], minus its mean: the net current is zero,
/// which the quadrature gives only up to its error.
Vector without_net_current(const Membrane& membrane, Vector current);

/// Rates of the charges on material points, divided by C_m: D q_i/Dt = σ_i E_i − I, D q_e/Dt = −σ_e E_e + I with the
/// current I through the membrane. No net current leaves a closed membrane on either side.
/// @param current  I, outwards, values on the upsampled grid, [n_points]
/// Source: docs/theory/electric.md
Unknowns charge_rates(const ChargingMembrane& of, const RelaxingField& field, const Vector& current);

}  // namespace vehd
