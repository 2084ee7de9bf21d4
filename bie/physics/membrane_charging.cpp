#include "bie/physics/membrane_charging.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "bie/physics/current_law.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

constexpr int kMostNewtonSteps = 60;

Vector stored_charge(const ChargingMembrane& of, const Vector& potential) {
  const Membrane& membrane = of.in_field.membrane;
  return capacitance_of(of.charging, membrane).cwiseProduct(Vector(membrane.fine.synthesize(potential)));
}

/// The charges q_i and q_e of the faces as a law between V and both fields: a = C_m, k = ε, s_i = q_i, s_e = q_e.
/// Without displacement currents q_i = −q_e = C_m V_m, and ε counts as zero.
CurrentLaw<double> law_of_charges(const ChargingMembrane& of, const Unknowns& charges) {
  const auto& [electric, membrane] = of.in_field;
  const Vector capacitance = capacitance_of(of.charging, membrane);
  if (!electric.displacement_current) {
    const Vector stored = stored_charge(of, charges.transmembrane_potential);
    return {capacitance, 0.0, 0.0, stored, -stored};
  }
  const double c = of.charging.capacitance;
  const Vector outer = charges.free_charge - charges.transmembrane_potential;
  return {capacitance, electric.permittivity_in(), electric.permittivity,
          c * membrane.fine.synthesize(charges.transmembrane_potential), c * membrane.fine.synthesize(outer)};
}

/// Backward Euler of D q_i/Dt = σ_i E_i − I, D q_e/Dt = −σ_e E_e + I with a current I = G V + J through the membrane,
/// which is (4e) without displacement currents: a = C_m/dt + G, k = σ + ε/dt, s_i = q_i/dt − J and s_e = q_e/dt + J.
/// @param dt      > 0
/// @param before  the charges at the start of the step
/// Source: paper Eqs. (4e), (30); docs/theory/electric.md
CurrentLaw<double> law_of_step(const ChargingMembrane& of, const MembraneCurrent& current, double dt,
                               const Unknowns& before) {
  const ElectricParameters& electric = of.in_field.electric;
  const CurrentLaw<double> held = law_of_charges(of, before);
  return {held.a / dt + current.conductance, electric.conductivity_in + held.k_in / dt,
          electric.conductivity_out + held.k_out / dt, held.s_in / dt - current.constant,
          held.s_out / dt + current.constant};
}

/// The charges at the end of a step, from V there.
Unknowns charges_after(const ChargingMembrane& of, const CurrentLaw<double>& law, const Vector& potential) {
  const auto& [electric, membrane] = of.in_field;
  if (!electric.displacement_current) return {{}, potential};
  const FieldsAtFaces<double> fields = fields_of(law, membrane, potential);
  const Vector displaced_in = electric.permittivity_in() * fields.in,
               displaced_out = electric.permittivity * fields.out;
  const double c = of.charging.capacitance;
  return {{},
          membrane.fine.analyze(Vector(stored_charge(of, potential) - displaced_in)) / c,
          membrane.fine.analyze(Vector(displaced_out - displaced_in)) / c};
}

/// Known part of an implicit step of s, s + residual − dt r(s, V), or s without a residual; on the upsampled grid.
/// @param potential  V at the start of the step, on the upsampled grid
Vector known_state(const PorationReaction& reaction, const SphereTransform& fine, double dt, const Vector& state,
                   const Unknowns* residual, const Vector& potential) {
  Vector known = fine.synthesize(state);
  if (residual == nullptr) return known;
  for (Index i = 0; i < known.size(); ++i) known[i] -= dt * reaction.rate(known[i], potential[i]);
  return known + Vector(fine.synthesize(residual->poration));
}

Vector state_after(const PorationReaction& reaction, const SphereTransform& fine, double dt, const Vector& known,
                   const Vector& potential) {
  const Vector reached = fine.synthesize(potential);
  const Vector s =
      known.binaryExpr(reached, [&](double k, double v) { return reaction.implicit_step(k, dt, v).value; });
  return fine.analyze(s);
}

/// A step of one membrane. The unknown w of its equation is V at the end, or the change of V in a correction.
class ChargingStep {
 public:
  /// @param of         must outlive it, as must `from` and `residual`
  /// @param potential  V_m at `from`; used only if the membrane porates
  ChargingStep(const ChargingMembrane& of, double dt, const Unknowns& from, const Unknowns* residual, Vector potential)
      : driven_(of), dt_(dt), from_(from), residual_(residual), potential_(std::move(potential)) {
    if (is_correction()) {
      driven_.in_field.electric.field.setZero();
      driven_.in_field.electric.pump = 0.0;
    }
    current_ = intact_ = membrane_current(driven_);
    if (!porates()) return;
    about_ = fine().synthesize(potential_);
    base_ = is_correction() ? about_ : Vector(Vector::Zero(about_.size()));
    known_ = known_state(*of.reaction, fine(), dt, from.poration, residual, about_);
    at_base_ = Vector(membrane_current(of, from.poration).conductance.cwiseProduct(base_));
    linearise();
  }

  [[nodiscard]] const ChargingMembrane& driven() const { return driven_; }
  [[nodiscard]] bool porates() const { return driven_.reaction != nullptr; }
  [[nodiscard]] CurrentLaw<double> law() const { return law_of_step(driven_, current_, dt_, before()); }
  /// Initial guess of the first solve.
  [[nodiscard]] const Vector& guess() const { return before().transmembrane_potential; }

  /// Largest change of V by a solution, and largest |V|.
  struct Move {
    double moved = 0.0, size = 0.0;
  };
  /// Linearises about the solution, with the change of V limited.
  Move advance(const Vector& solution) {
    if (!porates()) return {};
    const Vector reached = base_ + Vector(fine().synthesize(solution));
    const Move move{(reached - about_).cwiseAbs().maxCoeff(), reached.cwiseAbs().maxCoeff()};
    about_ = about_.binaryExpr(reached,
                               [&](double old, double next) { return driven_.reaction->damped_potential(old, next); });
    linearise();
    return move;
  }

  /// y from w and the law for which it was solved.
  [[nodiscard]] Unknowns reached(const CurrentLaw<double>& law, const Vector& solution) const {
    Unknowns y = charges_after(driven_, law, solution);
    if (is_correction()) {
      y.transmembrane_potential += from_.transmembrane_potential;
      if (y.free_charge.size() > 0) y.free_charge += from_.free_charge;
    }
    if (porates()) {
      const Vector potential = is_correction() ? Vector(potential_ + solution) : solution;
      y.poration = state_after(*driven_.reaction, fine(), dt_, known_, potential);
    }
    return y;
  }

 private:
  [[nodiscard]] bool is_correction() const { return residual_ != nullptr; }
  [[nodiscard]] const Unknowns& before() const { return is_correction() ? *residual_ : from_; }
  [[nodiscard]] const SphereTransform& fine() const { return driven_.in_field.membrane.fine; }

  /// Current as a function of w: that of V = base + w, linearised about the last V, minus that of the base.
  void linearise() {
    const PorationReaction& reaction = *driven_.reaction;
    for (Index i = 0; i < known_.size(); ++i) {
      const double v = about_[i], conductance = intact_.conductance[i];
      const PorationReaction::Slope s = reaction.implicit_step(known_[i], dt_, v);
      const PorationReaction::Slope g = reaction.conductance(s.value);
      const double current = (conductance + g.value) * v + intact_.constant[i];
      const double slope = conductance + g.value + g.slope * s.slope * v;
      current_.conductance[i] = slope;
      current_.constant[i] = current - at_base_[i] - slope * (v - base_[i]);
    }
  }

  ChargingMembrane driven_;  // without field and pump if it is a correction
  double dt_;
  const Unknowns& from_;
  const Unknowns* residual_;
  Vector potential_;
  MembraneCurrent intact_, current_;
  // Only for a membrane that porates, values on the upsampled grid.
  Vector known_;           // see known_state
  Vector base_, at_base_;  // V and the current through the membrane for w = 0
  Vector about_;           // V of the linearisation
};

/// Finds V_m of each membrane for these charges.
SolveReport find_potentials(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                            double tolerance, const std::vector<Unknowns>& charges, std::vector<Vector>& potentials) {
  for (const Unknowns& one : charges) potentials.push_back(one.transmembrane_potential);
  if (!membranes.front().in_field.electric.displacement_current) return {SolveEnd::converged, 0, 0.0};
  std::vector<CurrentLaw<double>> laws;
  for (std::size_t a = 0; a < membranes.size(); ++a) laws.push_back(law_of_charges(membranes[a], charges[a]));
  return solve_laws(membranes, interaction, laws, tolerance, potentials);
}

}  // namespace

SolveReport charge_membranes(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction, double dt,
                             double tolerance, const std::vector<Unknowns>& from, const std::vector<Unknowns>* residual,
                             std::vector<Unknowns>& reached) {
  const bool porates =
      std::ranges::any_of(membranes, [](const ChargingMembrane& of) { return of.reaction != nullptr; });
  std::vector<Vector> potentials(membranes.size());
  SolveReport report{SolveEnd::out_of_iterations, 0, 0.0};
  if (porates) {
    potentials.clear();
    report = find_potentials(membranes, interaction, tolerance, from, potentials);
    if (!report.converged()) return report;
    report.end = SolveEnd::out_of_iterations;
  }
  std::vector<ChargingStep> steps;
  std::vector<ChargingMembrane> driven;
  std::vector<Vector> solutions;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    steps.emplace_back(membranes[a], dt, from[a], residual == nullptr ? nullptr : &(*residual)[a], potentials[a]);
    driven.push_back(steps.back().driven());
    solutions.push_back(steps.back().guess());
  }
  std::vector<CurrentLaw<double>> laws;
  for (int i = 0; i < kMostNewtonSteps && !report.converged(); ++i) {
    laws.clear();
    for (const ChargingStep& step : steps) laws.push_back(step.law());
    const SolveReport one = solve_laws(driven, interaction, laws, tolerance, solutions);
    report.iterations += one.iterations;
    report.residual = one.residual;
    if (!one.converged()) break;
    ChargingStep::Move largest;
    for (std::size_t a = 0; a < steps.size(); ++a) {
      const ChargingStep::Move move = steps[a].advance(solutions[a]);
      largest = {std::max(largest.moved, move.moved), std::max(largest.size, move.size)};
    }
    if (largest.moved <= 10.0 * tolerance * largest.size) report.end = SolveEnd::converged;
  }
  reached.clear();
  for (std::size_t a = 0; a < steps.size(); ++a) reached.push_back(steps[a].reached(laws[a], solutions[a]));
  return report;
}

Vector react(const PorationReaction& reaction, const SphereTransform& fine, double dt, const Unknowns& from,
             const Unknowns* residual, const Vector& potential) {
  const Vector known =
      known_state(reaction, fine, dt, from.poration, residual, fine.synthesize(from.transmembrane_potential));
  return state_after(reaction, fine, dt, known, potential);
}

Vector reaction_rate(const PorationReaction& reaction, const SphereTransform& fine, const Vector& state,
                     const Vector& potential) {
  const Vector s = fine.synthesize(state), v = fine.synthesize(potential);
  const Vector rate = s.binaryExpr(v, [&](double a, double b) { return reaction.rate(a, b); });
  return fine.analyze(rate);
}

SolveReport steady_potentials(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                              double tolerance, std::vector<Vector>& potentials) {
  std::vector<CurrentLaw<double>> laws;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    const auto& [electric, membrane] = membranes[a].in_field;
    const MembraneCurrent current = membrane_current(membranes[a]);
    const bool conducts = current.conductance.maxCoeff() > 0.0;
    if (!conducts && series_conductivity(electric) == 0.0) {
      throw InputError(
          "a steady V_m is not determined: the membrane conductance and a bulk conductivity are both zero");
    }
    if (!conducts && membrane.material.pump_current.size() > 0) {
      throw InputError("a steady V_m is not determined: a pump works on a membrane that does not conduct");
    }
    if (potentials[a].size() == 0) potentials[a] = Vector::Zero(n_coefficients(membrane.fine.order()));
    laws.push_back({current.conductance, electric.conductivity_in, electric.conductivity_out, -current.constant,
                    current.constant});
  }
  return solve_laws(membranes, interaction, laws, tolerance, potentials);
}

Unknowns steady_charges(const ChargingMembrane& of, const Vector& potential) {
  const auto& [electric, membrane] = of.in_field;
  if (!electric.displacement_current) return {{}, potential};
  if (electric.conductivity_in == 0.0 || electric.conductivity_out == 0.0) {
    throw InputError(
        "a steady V_m with displacement currents needs fluids that both conduct; one conductivity is zero");
  }
  const Vector current = current_through(membrane, membrane_current(of), potential);
  const double in = electric.permittivity_in() / electric.conductivity_in;
  const double out = electric.permittivity / electric.conductivity_out;
  const double c = of.charging.capacitance;
  return {{},
          membrane.fine.analyze(Vector(stored_charge(of, potential) - in * current)) / c,
          membrane.fine.analyze(Vector((out - in) * current)) / c};
}

Vector without_net_current(const Membrane& membrane, Vector current) {
  const Vector& area = membrane.surface.quadrature;
  current.array() -= current.dot(area) / area.sum();
  return current;
}

std::vector<RelaxingField> fields_of_charges(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction, const std::vector<Unknowns>& charges,
                                             double tolerance, std::vector<Vector> start) {
  std::vector<CurrentLaw<double>> laws;
  for (std::size_t a = 0; a < membranes.size(); ++a) laws.push_back(law_of_charges(membranes[a], charges[a]));
  const SolveReport report = solve_laws(membranes, interaction, laws, tolerance, start);
  std::vector<ElectricTraces> traces = traces_of_laws(membranes, interaction, laws, start);
  std::vector<RelaxingField> fields;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    fields.push_back({std::move(start[a]), std::move(traces[a]), report});
  }
  return fields;
}

Unknowns charge_rates(const ChargingMembrane& of, const RelaxingField& field, const Vector& current) {
  const auto& [electric, membrane] = of.in_field;
  const Vector in = without_net_current(membrane, -electric.conductivity_in * field.traces.flux_in);
  const Vector out = without_net_current(membrane, -electric.conductivity_out * field.traces.flux_out);
  const double c = of.charging.capacitance;
  return {{}, membrane.fine.analyze(Vector(in - current)) / c, membrane.fine.analyze(Vector(in - out)) / c};
}

}  // namespace vehd
