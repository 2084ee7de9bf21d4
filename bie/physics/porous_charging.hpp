#pragma once

#include <optional>

#include "bie/physics/membrane_charging.hpp"
#include "bie/physics/poration_reaction.hpp"

namespace vehd {

/// V_m and the state s of a porating membrane, coefficients of degree p.
struct PorousState {
  Vector potential;
  Vector reaction;
};

/// (G_m + g(s)) V, the current through the membrane; values on the upsampled grid.
Vector porous_current(const PorationReaction& reaction, const ChargingParameters& charging, const Membrane& membrane,
                      const PorousState& state);

/// G_m + g(s), values on the upsampled grid.
Vector porous_conductance(const PorationReaction& reaction, const ChargingParameters& charging,
                          const Membrane& membrane, const Vector& state);

/// ds/dt, coefficients.
Vector reaction_rate(const PorationReaction& reaction, const Membrane& membrane, const PorousState& state);

/// One implicit step of V_m and s together.
struct PorousStep {
  /// That the step starts from: y_0, or what a node has now.
  PorousState from;
  /// What the node lacks of its equation, see Residual; empty: `from` is the start of a step of backward Euler.
  std::optional<PorousState> lacks{};
  double dt = 0.0;
};

/// Solves y − dt F(y) = from, or y − dt F(y) = from + lacks − dt F(from), for V and s, with F_V = (J − (G_m + g(s))V)/C_m
/// and F_s = r(s, V). Newton's method for V, s being eliminated at every point; each of its steps is one equation of
/// charging with a conductance that varies over the membrane.
/// @param electric   with the field at the end of the step; of a correction it does not count
/// @param state      y on output
/// @param tolerance  of the solves, relative; V goes on until it changes by ten times this
/// @return           iterations of all steps; not converged where V does not settle
/// Accuracy: V and s of a sphere with conductances that vary over it as an independent integrator has them
/// (tests/stepping/poration_steps_test.cpp)
/// Source: paper Eqs. (14), (30) with G_m(x)
SolveReport charge_porous_membrane(const ElectricParameters& electric, const ChargingParameters& charging,
                                   const PorationReaction& reaction, const Membrane& membrane, const PorousStep& step,
                                   double tolerance, PorousState& state);

/// The same of s alone, under a V that is known at the end of the step.
Vector react(const PorationReaction& reaction, const SphereTransform& fine, const PorousStep& step,
             const Vector& potential);

}  // namespace vehd
