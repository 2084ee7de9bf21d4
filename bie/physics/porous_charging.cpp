#include "bie/physics/porous_charging.hpp"

#include <algorithm>
#include <utility>

#include "bie/physics/coupled_charging.hpp"

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

/// Newton's method for V of one membrane: what it asks for next. The unknown w is V of a step, and what a correction
/// adds to it.
class PorousIteration {
 public:
  /// @param of  must outlive it
  explicit PorousIteration(const PorousMembrane& of)
      : of_(of), driven_(of.charging.in_field.electric), known_(known_of(of.reaction, fine(), of.step)) {
    const Membrane& membrane = of.charging.in_field.membrane;
    const PorousStep& step = of.step;
    const Vector from = fine().synthesize(step.from.potential);
    if (step.lacks) {
      driven_.field.setZero();
      driven_.pump = 0.0;
    }
    intact_ = membrane_current(driven_, of.charging.charging, membrane);
    storage_ = capacitance_of(of.charging.charging, membrane) / step.dt;
    base_ = step.lacks ? from : Vector(Vector::Zero(from.size()));
    about_ = from;
    // What goes through the membrane already where a correction begins.
    known_current_ = Vector::Zero(from.size());
    if (step.lacks) known_current_ = porous_current(of.reaction, of.charging.charging, membrane, step.from);
    linearise();
  }

  /// The problem without a field where a correction is asked for.
  [[nodiscard]] ElectricMembrane in_field() const { return {driven_, of_.charging.in_field.membrane}; }
  [[nodiscard]] Vector start() const {
    const Vector& from = of_.step.from.potential;
    return of_.step.lacks ? Vector(Vector::Zero(from.size())) : from;
  }

  /// (C_m/dt + slope) w − b, with all that does not depend on w in b.
  [[nodiscard]] ChargingStep charging() const {
    const Vector& starts = of_.step.lacks ? of_.step.lacks->potential : of_.step.from.potential;
    const Vector given = storage_.cwiseProduct(Vector(fine().synthesize(starts))) + known_current_;
    return {(at_.slope.array() + storage_.array()).matrix(),
            given - at_.current + at_.slope.cwiseProduct(about_ - base_)};
  }
  /// The current of w in it.
  [[nodiscard]] MembraneCurrent current() const {
    return {at_.slope, at_.current - known_current_ - at_.slope.cwiseProduct(about_ - base_)};
  }

  /// How far a solution moves V, and the size of V.
  struct Move {
    double moved = 0.0, size = 0.0;
  };
  /// Goes on from a solution.
  Move advance(const Vector& solution) {
    const Vector reached = base_ + Vector(fine().synthesize(solution));
    const Move move{(reached - about_).cwiseAbs().maxCoeff(), reached.cwiseAbs().maxCoeff()};
    about_ = about_.binaryExpr(reached, [&](double old, double next) { return of_.reaction.limited(old, next); });
    linearise();
    return move;
  }

  /// V and s that go with a solution.
  [[nodiscard]] PorousState state(const Vector& solution) const {
    PorousState result{of_.step.lacks ? Vector(of_.step.from.potential + solution) : solution, {}};
    result.reaction = react(of_.reaction, fine(), of_.step, result.potential);
    return result;
  }

 private:
  [[nodiscard]] const SphereTransform& fine() const { return of_.charging.in_field.membrane.fine; }

  void linearise() {
    const PorationReaction& reaction = of_.reaction;
    at_ = {Vector(known_.size()), Vector(known_.size())};
    for (Index i = 0; i < known_.size(); ++i) {
      const double v = about_[i], conductance = intact_.conductance[i];
      const PorationReaction::Slope s = reaction.implicit_step(known_[i], of_.step.dt, v);
      const PorationReaction::Slope g = reaction.conductance(s.value);
      at_.current[i] = (conductance + g.value) * v + intact_.constant[i];
      at_.slope[i] = conductance + g.value + g.slope * s.slope * v;
    }
  }

  const PorousMembrane& of_;
  ElectricParameters driven_;
  Vector known_;  // of s
  MembraneCurrent intact_;
  Vector storage_;               // C_m/dt
  Vector base_, known_current_;  // V and the current through the membrane at which w is zero
  Vector about_;                 // V at which the slopes are taken
  Linearised at_;
};

/// Newton's method for all membranes together.
/// @param solve      solves what the iterations ask for: solve(solutions)
/// @param solutions  w of each on output
template <typename Solve>
SolveReport iterate(std::vector<PorousIteration>& iterations, const Solve& solve, double tolerance,
                    std::vector<Vector>& solutions) {
  for (const PorousIteration& iteration : iterations) solutions.push_back(iteration.start());
  SolveReport report{SolveEnd::out_of_iterations, 0, 0.0};
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    const SolveReport one = solve(solutions);
    report.iterations += one.iterations;
    report.residual = one.residual;
    if (!one.converged()) return report;
    PorousIteration::Move largest;
    for (std::size_t a = 0; a < iterations.size(); ++a) {
      const PorousIteration::Move move = iterations[a].advance(solutions[a]);
      largest = {std::max(largest.moved, move.moved), std::max(largest.size, move.size)};
    }
    if (largest.moved > 10.0 * tolerance * largest.size) continue;
    report.end = SolveEnd::converged;
    break;
  }
  return report;
}

std::vector<PorousIteration> iterations_of(const std::vector<PorousMembrane>& membranes) {
  std::vector<PorousIteration> result;
  result.reserve(membranes.size());
  for (const PorousMembrane& membrane : membranes) result.emplace_back(membrane);
  return result;
}

std::vector<PorousState> states_of(const std::vector<PorousIteration>& iterations,
                                   const std::vector<Vector>& solutions) {
  std::vector<PorousState> states;
  for (std::size_t a = 0; a < iterations.size(); ++a) states.push_back(iterations[a].state(solutions[a]));
  return states;
}

}  // namespace

Vector porous_conductance(const PorationReaction& reaction, const ChargingParameters& charging,
                          const Membrane& membrane, const Vector& state) {
  return conductance_of(charging, membrane) +
         Vector(membrane.fine.synthesize(state)).unaryExpr([&](double s) { return reaction.conductance(s).value; });
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

SolveReport charge_porous_membranes(const std::vector<PorousMembrane>& membranes, const Interaction* interaction,
                                    double tolerance, std::vector<PorousState>& states) {
  std::vector<PorousIteration> iterations = iterations_of(membranes);
  std::vector<ElectricMembrane> in_field;
  for (const PorousIteration& iteration : iterations) in_field.push_back(iteration.in_field());
  const auto solve = [&](std::vector<Vector>& solutions) {
    if (interaction == nullptr) {
      const ChargingStep step = iterations.front().charging();
      return solve_varying_charging(in_field.front().electric, in_field.front().membrane, step.a, step.b, tolerance,
                                    solutions.front());
    }
    std::vector<ChargingStep> steps;
    for (const PorousIteration& iteration : iterations) steps.push_back(iteration.charging());
    return solve_varying_charging(in_field, *interaction, std::move(steps), tolerance, solutions);
  };
  std::vector<Vector> solutions;
  const SolveReport report = iterate(iterations, solve, tolerance, solutions);
  states = states_of(iterations, solutions);
  return report;
}

SolveReport relax_porous_membranes(const std::vector<PorousMembrane>& membranes, const Interaction* interaction,
                                   double tolerance, std::vector<FaceCharges>& charges,
                                   std::vector<PorousState>& states) {
  std::vector<PorousIteration> iterations = iterations_of(membranes);
  std::vector<ChargingMembrane> driven;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    driven.push_back({iterations[a].in_field(), membranes[a].charging.charging});
  }
  std::vector<FaceLaw> laws(membranes.size());
  const auto solve = [&](std::vector<Vector>& solutions) {
    for (std::size_t a = 0; a < laws.size(); ++a) {
      laws[a] = law_of_step(driven[a], iterations[a].current(), membranes[a].step.dt, charges[a]);
    }
    return interaction == nullptr ? solve_law(driven.front().in_field, laws.front(), tolerance, solutions.front())
                                  : solve_laws(driven, *interaction, laws, tolerance, solutions);
  };
  std::vector<Vector> solutions;
  const SolveReport report = iterate(iterations, solve, tolerance, solutions);
  for (std::size_t a = 0; a < laws.size(); ++a) charges[a] = charges_after(driven[a], laws[a], solutions[a]);
  states = states_of(iterations, solutions);
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
