#pragma once

#include <optional>
#include <vector>

#include "bie/physics/charge_relaxation.hpp"
#include "bie/physics/poration_reaction.hpp"

namespace vehd {

/// V_m and the state s of a porating membrane, coefficients of degree p.
struct PorousState {
  Vector potential;
  Vector reaction;
};

/// G_m + g(s), values on the upsampled grid.
Vector porous_conductance(const PorationReaction& reaction, const ChargingParameters& charging,
                          const Membrane& membrane, const Vector& state);

/// ds/dt, coefficients.
Vector reaction_rate(const PorationReaction& reaction, const Membrane& membrane, const PorousState& state);

/// What an implicit step of V_m and s together starts from.
struct PorousStep {
  /// That the step starts from: y_0, or what a node has now. V_m is that of its charges where these are unknowns.
  PorousState from;
  /// What the node lacks of its equation, see Residual; empty: `from` is the start of a step of backward Euler. Of V_m
  /// it does not count where charges are unknowns.
  std::optional<PorousState> lacks{};
  double dt = 0.0;
};

/// One membrane that porates. Of a correction field and pump do not count.
struct PorousMembrane {
  ChargingMembrane charging;  ///< with the field at the end of the step
  const PorationReaction& reaction;
  PorousStep step;
};

/// Solves y − dt F(y) = from, or y − dt F(y) = from + lacks − dt F(from), for V and s of all membranes, with
/// F_V = (σ_i E_i − (G_m + g(s))V − J_p)/C_m and F_s = r(s, V). Newton's method for V, s being eliminated at every
/// point; each of its steps is one equation of charging with a conductance that varies over the membranes.
/// @param interaction  of the membranes; null where there is one
/// @param states       y of each on output
/// @param tolerance    of the solves, relative; V goes on until it changes by ten times this
/// @return             iterations of all steps; not converged where V does not settle
/// Accuracy: V and s of a sphere with conductances that vary over it as an independent integrator has them
/// (tests/stepping/poration_steps_test.cpp)
/// Source: paper Eqs. (14), (30) with G_m(x)
SolveReport charge_porous_membranes(const std::vector<PorousMembrane>& membranes, const Interaction* interaction,
                                    double tolerance, std::vector<PorousState>& states);

/// The same with displacement currents: the charges of the faces are the unknowns in place of V, with
/// F_qi = σ_i E_i − (G_m + g(s))V − J_p and F_qe = −σ_e E_e + (G_m + g(s))V + J_p.
/// @param charges  on input those that the steps start from, or what they lack; on output those at the end, or what is
///     added
/// Source: docs/theory/electric.md
SolveReport relax_porous_membranes(const std::vector<PorousMembrane>& membranes, const Interaction* interaction,
                                   double tolerance, std::vector<FaceCharges>& charges,
                                   std::vector<PorousState>& states);

/// The same of s alone, under a V that is known at the end of the step.
Vector react(const PorationReaction& reaction, const SphereTransform& fine, const PorousStep& step,
             const Vector& potential);

}  // namespace vehd
