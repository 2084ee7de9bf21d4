#include "bie/physics/porous_charging.hpp"

#include <algorithm>
#include <utility>

#include "bie/physics/membrane_charging.hpp"

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
    intact_ = membrane_current(driven());
    base_ = step.lacks ? from : Vector(Vector::Zero(from.size()));
    about_ = from;
    // What goes through the membrane already where a correction begins.
    known_current_ = Vector::Zero(from.size());
    if (step.lacks) {
      known_current_ =
          porous_conductance(of.reaction, of.charging.charging, membrane, step.from.reaction).cwiseProduct(from);
    }
    linearise();
  }

  /// The membrane without a field where a correction is asked for.
  [[nodiscard]] ChargingMembrane driven() const {
    return {{driven_, of_.charging.in_field.membrane}, of_.charging.charging};
  }
  [[nodiscard]] Vector start() const {
    const Vector& from = of_.step.from.potential;
    return of_.step.lacks ? Vector(Vector::Zero(from.size())) : from;
  }

  /// V that w starts from.
  [[nodiscard]] const Vector& before() const {
    return of_.step.lacks ? of_.step.lacks->potential : of_.step.from.potential;
  }
  /// The current of w.
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
  Vector base_, known_current_;  // V and the current through the membrane at which w is zero
  Vector about_;                 // V at which the slopes are taken
  Linearised at_;
};

/// Newton's method for all membranes together.
/// @param law_of     the law of membrane a under the current of its w: law_of(a, current)
/// @param laws       the last ones on output
/// @param solutions  w of each on output
template <typename LawOf>
SolveReport iterate(std::vector<PorousIteration>& iterations, const Interaction* interaction, const LawOf& law_of,
                    double tolerance, std::vector<CurrentLaw>& laws, std::vector<Vector>& solutions) {
  std::vector<ElectricMembrane> in_field;
  for (const PorousIteration& iteration : iterations) {
    in_field.push_back(iteration.driven().in_field);
    solutions.push_back(iteration.start());
  }
  SolveReport report{SolveEnd::out_of_iterations, 0, 0.0};
  for (int i = 0; i < kMostNewtonSteps; ++i) {
    laws.clear();
    for (std::size_t a = 0; a < iterations.size(); ++a) laws.push_back(law_of(a, iterations[a].current()));
    const SolveReport one = solve_laws(in_field, interaction, laws, tolerance, solutions);
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

Vector reaction_rate(const PorationReaction& reaction, const Membrane& membrane, const PorousState& state) {
  const Vector s = membrane.fine.synthesize(state.reaction);
  const Vector potential = membrane.fine.synthesize(state.potential);
  const Vector rate = s.binaryExpr(potential, [&](double a, double v) { return reaction.rate(a, v); });
  return membrane.fine.analyze(rate);
}

SolveReport charge_porous_membranes(const std::vector<PorousMembrane>& membranes, const Interaction* interaction,
                                    double tolerance, std::vector<PorousState>& states) {
  std::vector<PorousIteration> iterations = iterations_of(membranes);
  const auto law_of = [&](std::size_t a, const MembraneCurrent& current) {
    return law_of_charging(iterations[a].driven(), current, membranes[a].step.dt, iterations[a].before());
  };
  std::vector<CurrentLaw> laws;
  std::vector<Vector> solutions;
  const SolveReport report = iterate(iterations, interaction, law_of, tolerance, laws, solutions);
  states = states_of(iterations, solutions);
  return report;
}

SolveReport relax_porous_membranes(const std::vector<PorousMembrane>& membranes, const Interaction* interaction,
                                   double tolerance, std::vector<FaceCharges>& charges,
                                   std::vector<PorousState>& states) {
  std::vector<PorousIteration> iterations = iterations_of(membranes);
  const auto law_of = [&](std::size_t a, const MembraneCurrent& current) {
    return law_of_step(iterations[a].driven(), current, membranes[a].step.dt, charges[a]);
  };
  std::vector<CurrentLaw> laws;
  std::vector<Vector> solutions;
  const SolveReport report = iterate(iterations, interaction, law_of, tolerance, laws, solutions);
  for (std::size_t a = 0; a < laws.size(); ++a) {
    charges[a] = charges_after(iterations[a].driven(), laws[a], solutions[a]);
  }
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
