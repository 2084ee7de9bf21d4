#include "bie/physics/porous_charging.hpp"

namespace vehd {

namespace {

constexpr int kMostNewtonSteps = 60;

/// s + lacks − dt r(s, V), what an implicit step of s starts from; values on the upsampled grid.
Vector known_of(const PorationReaction& reaction, const SphereTransform& fine, const PorousStep& step) {
  Vector known = fine.synthesize(step.from.reaction);
  if (!step.lacks) return known;
  const Vector potential = fine.synthesize(step.from.potential);
  for (Index i = 0; i < known.size(); ++i) known[i] -= step.dt * reaction.rate(known[i], potential[i]);
  return known + Vector(fine.synthesize(step.lacks->reaction));
}

/// The current through the membrane under a potential at the end of a step, linear about that potential.
struct Linearised {
  Vector current, slope;
};

Linearised linearised(const PorationReaction& reaction, double conductance, const Vector& known, double dt,
                      const Vector& potential) {
  Linearised result{Vector(known.size()), Vector(known.size())};
  for (Index i = 0; i < known.size(); ++i) {
    const double v = potential[i];
    const PorationReaction::Slope s = reaction.implicit_step(known[i], dt, v);
    const PorationReaction::Slope g = reaction.conductance(s.value);
    result.current[i] = (conductance + g.value) * v;
    result.slope[i] = conductance + g.value + g.slope * s.slope * v;
  }
  return result;
}

}  // namespace

Vector porous_conductance(const PorationReaction& reaction, const ChargingParameters& charging,
                          const Membrane& membrane, const Vector& state) {
  return Vector(membrane.fine.synthesize(state)).unaryExpr([&](double s) {
    return charging.conductance + reaction.conductance(s).value;
  });
}

Vector porous_current(const PorationReaction& reaction, const ChargingParameters& charging, const Membrane& membrane,
                      const PorousState& state) {
  return porous_conductance(reaction, charging, membrane, state.reaction)
      .cwiseProduct(Vector(membrane.fine.synthesize(state.potential)));
}

Vector reaction_rate(const PorationReaction& reaction, const Membrane& membrane, const PorousState& state) {
  const Vector s = membrane.fine.synthesize(state.reaction);
  const Vector potential = membrane.fine.synthesize(state.potential);
  const Vector rate = s.binaryExpr(potential, [&](double a, double v) { return reaction.rate(a, v); });
  return membrane.fine.analyze(rate);
}

SolveReport charge_porous_membrane(const ElectricParameters& electric, const ChargingParameters& charging,
                                   const PorationReaction& reaction, const Membrane& membrane, const PorousStep& step,
                                   double tolerance, PorousState& state) {
  const SphereTransform& fine = membrane.fine;
  const double storage = charging.capacitance / step.dt;
  const Vector known = known_of(reaction, fine, step);
  // The unknown w is V of a step, and what a correction adds to it.
  const Vector from = fine.synthesize(step.from.potential);
  Vector base = Vector::Zero(known.size()), given = storage * from;
  ElectricParameters driven = electric;
  Vector change = step.from.potential;
  if (step.lacks) {
    base = from;
    given = storage * Vector(fine.synthesize(step.lacks->potential)) +
            porous_current(reaction, charging, membrane, step.from);
    driven.field.setZero();
    change.setZero();
  }
  Vector about = from;
  SolveReport report{SolveEnd::out_of_iterations, 0, 0.0};
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    const Linearised at = linearised(reaction, charging.conductance, known, step.dt, about);
    // (storage + slope) w − b, with all that does not depend on w in b.
    const Vector b = given - at.current + at.slope.cwiseProduct(about - base);
    const Vector a = (at.slope.array() + storage).matrix();
    const SolveReport one = solve_varying_charging(driven, membrane, a, b, tolerance, change);
    report.iterations += one.iterations;
    report.residual = one.residual;
    if (!one.converged()) return report;
    const Vector reached = base + Vector(fine.synthesize(change));
    const double moved = (reached - about).cwiseAbs().maxCoeff();
    const bool settled = moved <= 10.0 * tolerance * reached.cwiseAbs().maxCoeff();
    about = about.binaryExpr(reached, [&](double old, double next) { return reaction.limited(old, next); });
    if (!settled) continue;
    report.end = SolveEnd::converged;
    break;
  }
  state.potential = step.lacks ? Vector(step.from.potential + change) : change;
  state.reaction = react(reaction, fine, step, state.potential);
  return report;
}

Vector react(const PorationReaction& reaction, const SphereTransform& fine, const PorousStep& step,
             const Vector& potential) {
  const Vector known = known_of(reaction, fine, step);
  const Vector reached = fine.synthesize(potential);
  const Vector s =
      known.binaryExpr(reached, [&](double k, double v) { return reaction.implicit_step(k, step.dt, v).value; });
  return fine.analyze(s);
}

}  // namespace vehd
