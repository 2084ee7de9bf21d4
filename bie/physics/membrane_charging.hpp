#pragma once

#include <vector>

#include "bie/physics/current_law.hpp"
#include "bie/physics/unknowns.hpp"

namespace vehd {

/// One implicit step of the charging of all membranes and of the state s of those that porate,
///   y − dt F(y) = from,   or with a residual   y − dt F(y) = from + residual − dt F(from),
/// F_qi = σ_i E_i − (G_m + g(s)) V − J_p, F_qe = −σ_e E_e + (G_m + g(s)) V + J_p, F_s = r(s, V); without displacement
/// currents that is C_m dV_m/dt = σ_i E_i − (G_m + g(s)) V_m − J_p. One solve for V where no membrane porates;
/// elsewhere Newton's method for V, s being eliminated at every point, each of its steps such a solve. With a = C_m/dt
/// + G_m, b = (C_m/dt) V_m − J_p and κ = σ_i σ_e/(σ_i + σ_e) the V of one membrane without displacement currents obeys
///   (½ + ηS′)(a V − b) − κ D′[V] = κ E·n.
/// @param membranes  with the field and the pump at the end of the step; those of a correction do not count
/// @param dt         > 0
/// @param tolerance  of the solves, relative; Newton's method goes on until V changes by ten times this
/// @param from       their charges and s; positions do not count
/// @param residual   null for a step of backward Euler
/// @param reached    y of each on output, without position
/// @return  iterations of all solves; not converged where V does not settle
/// @throws InputError  as solve_laws
/// Accuracy: first order in dt, spectral in space; each step on the sphere is backward Euler to 1e-11, with
/// displacement currents to 1e-10 (tests/physics/charging_test.cpp, tests/physics/charge_relaxation_test.cpp); the
/// multipoles of two spheres charge as their linear system says (tests/physics/charge_density_test.cpp); spheres that
/// porate as an independent integrator has them (tests/stepping/poration_steps_test.cpp) Source: paper Eqs. (14), (29),
/// (30), without the inverse
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
/// @param potentials   coefficients [n_coefficients]: first guesses on input, empty ones are zero; the steady V_m of
/// each
///     on output
/// @throws InputError  if nothing determines it (a membrane and a fluid that both insulate, or an insulating membrane
///     with a pump), or as solve_laws
/// Accuracy: spectral; on the sphere to 1e-11 (tests/physics/charging_test.cpp), on an insulating 2:1 prolate to 1e-10
/// (tests/physics/electric_prolate_test.cpp), two spheres act as insulators to 1e-8
/// (tests/physics/charge_density_test.cpp)
/// Source: paper Eq. (14) without its first term
SolveReport steady_potentials(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                              double tolerance, std::vector<Vector>& potentials);

/// The charges of a steady state with a given V_m, coefficients [n_coefficients]: σ_k E_k = G_m V_m + J_p.
/// @throws InputError where there are displacement currents and a fluid insulates
Unknowns steady_charges(const ChargingMembrane& of, const Vector& potential);

/// The electric state that belongs to charges of the faces and a field.
struct RelaxingField {
  Vector potential;       ///< V_m, coefficients [n_coefficients]
  ElectricTraces traces;  ///< the charge in them is [[∂φ/∂n]], no free charge
  SolveReport report;     ///< that of all membranes
};

/// Solves (½ + ηS′)(C_m V − q_i) − κ D′[V] = κ (E·n − ½ Q/ε_e − S′[Q/ε_e]), η and κ of the permittivities,
/// Q = q_i + q_e, for V, of several membranes with the layers of all, and with it everything on them.
/// @param start  first guesses of V, coefficients [n_coefficients]; empty ones are zero
/// @returns      traces of membranes of other ranks, see Interaction, are empty
/// Accuracy: spectral; both rates of a sphere to 1e-9 (tests/physics/charge_relaxation_test.cpp), forces between two
/// spheres at a gap of half a radius to 1e-7 at p = 16 (tests/physics/coupled_relaxation_test.cpp)
/// Source: docs/theory/electric.md
std::vector<RelaxingField> fields_of_charges(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction, const std::vector<Unknowns>& charges,
                                             double tolerance, std::vector<Vector> start);

/// A current on a closed membrane, values on the upsampled grid, less its mean: no net current leaves, which the
/// quadrature sees only up to its error.
Vector without_net_current(const Membrane& membrane, Vector current);

/// Rates of the charges on material points, over C_m: D q_i/Dt = σ_i E_i − I, D q_e/Dt = −σ_e E_e + I with the current
/// I through the membrane. No net current leaves a closed membrane on either side.
/// @param current  I, outwards, values on the upsampled grid, [n_points]
/// Source: docs/theory/electric.md
Unknowns charge_rates(const ChargingMembrane& of, const RelaxingField& field, const Vector& current);

}  // namespace vehd
