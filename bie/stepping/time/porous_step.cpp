#include "bie/stepping/time/porous_step.hpp"

#include <utility>

#include "bie/physics/porous_charging.hpp"

namespace vehd {

namespace {

/// One step on its way.
class Step {
 public:
  Step(const Model& model, const SolvedFields& at_start, const std::vector<ElectricParameters>& electric, double dt,
       double tolerance, const std::vector<Charge>& from, const std::vector<Charge>* lacks)
      : model_(model), at_start_(at_start), dt_(dt), tolerance_(tolerance), from_(from), lacks_(lacks) {
    for (std::size_t a = 0; a < electric.size(); ++a) {
      charging_.push_back({{electric[a], *at_start.vesicles[a].membrane}, model.vesicles[a].charging});
    }
  }

  /// Without a field or charge.
  [[nodiscard]] std::vector<Charge> reacted() const {
    std::vector<Charge> reached = from_;
    for (std::size_t a = 0; a < reached.size(); ++a) {
      const PorousStep step = porous_step(a, from_[a].potential);
      reached[a].poration =
          react(*model_.vesicles[a].reaction, at_start_.vesicles[a].membrane->fine, step, from_[a].potential);
    }
    return reached;
  }

  SolveReport charged(std::vector<Charge>& reached) const {
    std::vector<PorousState> states;
    std::vector<Vector> potentials;
    for (const Charge& one : from_) potentials.push_back(one.potential);
    const SolveReport report = charge_porous_membranes(membranes(potentials), interaction(), tolerance_, states);
    reached.clear();
    for (PorousState& state : states) reached.push_back({std::move(state.potential), {}, std::move(state.reaction)});
    return report;
  }

  /// The same of charges of the faces.
  SolveReport relaxed(std::vector<Charge>& reached) const {
    std::vector<Vector> potentials;
    SolveReport first = find_potentials(potentials);
    if (!first.converged()) return first;
    std::vector<FaceCharges> charges;
    for (const Charge& one : lacks_ == nullptr ? from_ : *lacks_) charges.push_back({one.potential, one.free});
    std::vector<PorousState> states;
    SolveReport report = relax_porous_membranes(membranes(potentials), interaction(), tolerance_, charges, states);
    report.iterations += first.iterations;
    reached.clear();
    for (std::size_t a = 0; a < states.size(); ++a) {
      Charge& of_one = reached.emplace_back(
          Charge{std::move(charges[a].inner), std::move(charges[a].sum), std::move(states[a].reaction)});
      if (lacks_ == nullptr) continue;
      of_one.potential += from_[a].potential;
      of_one.free += from_[a].free;
    }
    return report;
  }

 private:
  [[nodiscard]] const Interaction* interaction() const { return at_start_.interaction.get(); }

  [[nodiscard]] PorousStep porous_step(std::size_t a, const Vector& potential) const {
    PorousStep step{{potential, from_[a].poration}, {}, dt_};
    if (lacks_ != nullptr) step.lacks = {(*lacks_)[a].potential, (*lacks_)[a].poration};
    return step;
  }

  [[nodiscard]] std::vector<PorousMembrane> membranes(const std::vector<Vector>& potentials) const {
    std::vector<PorousMembrane> result;
    for (std::size_t a = 0; a < charging_.size(); ++a) {
      result.push_back({charging_[a], *model_.vesicles[a].reaction, porous_step(a, potentials[a])});
    }
    return result;
  }

  /// V_m that goes with the charges that the step starts from.
  SolveReport find_potentials(std::vector<Vector>& potentials) const {
    std::vector<CurrentLaw> laws;
    std::vector<ElectricMembrane> in_field;
    for (std::size_t a = 0; a < from_.size(); ++a) {
      laws.push_back(law_of_charges(charging_[a], {from_[a].potential, from_[a].free}));
      in_field.push_back(charging_[a].in_field);
      potentials.push_back(at_start_.fields.vesicles[a].potential);
    }
    return solve_laws(in_field, interaction(), laws, tolerance_, potentials);
  }

  const Model& model_;
  const SolvedFields& at_start_;
  double dt_, tolerance_;
  const std::vector<Charge>& from_;
  const std::vector<Charge>* lacks_;
  std::vector<ChargingMembrane> charging_;
};

}  // namespace

SolveReport porous_step(const Model& model, const SolvedFields& at_start,
                        const std::vector<ElectricParameters>& electric, double dt, double tolerance,
                        const std::vector<Charge>& from, const std::vector<Charge>* lacks,
                        std::vector<Charge>& reached) {
  const Step step(model, at_start, electric, dt, tolerance, from, lacks);
  if (!electric.empty()) return relaxes_charge(model) ? step.relaxed(reached) : step.charged(reached);
  reached = step.reacted();
  return {SolveEnd::converged, 0, 0.0};
}

}  // namespace vehd
