#include "bie/comparison/coupled_check_fields.hpp"

#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "bie/comparison/local_forces.hpp"
#include "bie/physics/charge_density.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/physics/membrane_flow.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/solve/flow_system.hpp"
#include "bie/stepping/state/resized.hpp"

namespace vehd {
namespace {

std::vector<ResolutionLevel> levels_of(const std::vector<int>& orders) {
  std::vector<ResolutionLevel> result;
  for (const int order : orders) result.push_back({order, 1.0});
  return result;
}

/// Each membrane in a degree of its own.
State resized_to(State state, const std::vector<int>& orders) {
  for (std::size_t a = 0; a < orders.size(); ++a) {
    state.vesicles[a] = resized(std::move(state.vesicles[a]), orders[a]);
  }
  return state;
}

/// Where one membrane is resolved as another degree asks for, solvers are no coarser than their defaults.
NumericalSettings settings_of(const FrozenState& frozen, const std::vector<int>& orders) {
  NumericalSettings settings = frozen.settings;
  for (std::size_t a = 0; a < orders.size(); ++a) {
    const NumericalSettings own = settings_at(frozen, orders[a], a);
    settings.flow_tolerance = std::min(settings.flow_tolerance, own.flow_tolerance);
    settings.electric_tolerance = std::min(settings.electric_tolerance, own.electric_tolerance);
  }
  return settings;
}

/// The frozen problem of all membranes.
class CoupledFrozenSolver {
 public:
  CoupledFrozenSolver(const FrozenState& frozen, const CheckContents& contents, const std::vector<int>& orders)
      : frozen_(frozen),
        settings_(settings_of(frozen, orders)),
        state_(resized_to(frozen.state, orders)),
        solved_(solve_fields(compared_model(frozen, contents),
                             Discretisation(settings_, frozen.symmetry, levels_of(orders)), state_, instruments_)),
        results(orders.size()) {
    for (std::size_t a = 0; a < orders.size(); ++a) {
      const VesicleModel& vesicle = frozen.model.vesicles[a];
      results[a].order = orders[a];
      if (contents.electric) {
        in_field_.push_back(
            {electric_parameters(frozen.model, vesicle).at(frozen.state.time, Limit::after), membrane(a)});
      }
      if (contents.flow) in_flow_.push_back({flow_parameters(frozen.model, vesicle), membrane(a)});
    }
  }

  void take_prescribed() {
    for (std::size_t a = 0; a < results.size(); ++a) {
      const VesicleFields& fields = solved_.fields.vesicles[a];
      results[a].charge = fields.charge;
      results[a].force_electric = fields.force_electric;
      results[a].potential_rate = solved_.vesicles[a].rate.transmembrane_potential;
    }
  }

  void solve_steady() {
    const Interaction& interaction = *solved_.interaction;
    std::vector<ChargingMembrane> membranes;
    std::vector<Vector> potentials(results.size());
    for (std::size_t a = 0; a < results.size(); ++a) {
      membranes.push_back({in_field_[a], frozen_.model.vesicles[a].charging});
    }
    require_converged(steady_potentials(membranes, interaction, settings_.electric_tolerance, potentials),
                      "steady membrane potentials");
    const std::vector<SecondKindSolution> densities = solve_second_kind(
        in_field_, interaction, weighted_fluxes(in_field_, interaction, potentials), settings_.electric_tolerance);
    require_converged(densities.front().report, "charge densities, Eq. (12)");
    const std::vector<Vector> of_others = potentials_of_others(in_field_, interaction, potentials, densities);
    std::vector<Vector> charges(results.size());
    for (const std::size_t a : interaction.shares().own(results.size())) {
      const ElectricTraces traces =
          electric_traces(in_field_[a].electric, membrane(a), potentials[a], densities[a], of_others[a]);
      charges[a] = membrane(a).fine.analyze(traces.charge);
    }
    interaction.gather_potentials(charges);
    for (std::size_t a = 0; a < results.size(); ++a) {
      if (membranes[a].charging.conductance == 0.0) remove_mean(membrane(a), potentials[a]);
      results[a].steady_charge = std::move(charges[a]);
      results[a].steady_potential = std::move(potentials[a]);
    }
  }

  void solve_flow(const std::vector<Matrix>& forces) {
    MembraneFlow flow(in_flow_, *solved_.interaction);
    std::vector<Matrix> given, own;
    for (std::size_t a = 0; a < results.size(); ++a) {
      const VesicleFields& fields = solved_.fields.vesicles[a];
      LocalForces local = local_forces_beside(frozen_, membrane(a), state_.vesicles[a].position, a);
      results[a].force_order = local.order;
      results[a].force_bending = std::move(local.bending);
      results[a].force_tension = fields.force_tension;
      results[a].tension = fields.tension;
      results[a].tension_is_free = solved_.vesicles[a].is_sphere;
      results[a].velocity_of_shape = fields.velocity;
      given.push_back(resize_order(forces[a], results[a].order));
      if (results[a].force_electric.size() == 0) continue;
      const Matrix stored = resize_order(frozen_.fields.vesicles[a].force_electric, results[a].order);
      own.push_back(given[a] + stored - results[a].force_electric);
    }
    const std::vector<Matrix> velocities = velocities_of(flow, given);
    for (std::size_t a = 0; a < results.size(); ++a) results[a].velocity = velocities[a];
    if (!own.empty()) {
      const std::vector<Matrix> own_velocities = velocities_of(flow, own);
      for (std::size_t a = 0; a < results.size(); ++a) results[a].velocity_own_force = own_velocities[a];
    }
    find_truncation(flow);
  }

 private:
  [[nodiscard]] const Membrane& membrane(std::size_t a) const { return *solved_.vesicles[a].membrane; }

  /// Of the background flow and forces, coefficients; those of images follow from their originals.
  [[nodiscard]] std::vector<Matrix> velocities_of(MembraneFlow& flow, const std::vector<Matrix>& forces) const {
    std::vector<Matrix> weighted, background;
    for (std::size_t a = 0; a < results.size(); ++a) {
      weighted.push_back(membrane(a).weighted(membrane(a).fine.synthesize(forces[a])));
      background.push_back(state_.vesicles[a].position * flow_gradient(frozen_).transpose());
    }
    std::vector<Matrix> velocities = flow.velocities(weighted, background);
    solved_.interaction->gather_vectors(velocities);
    return velocities;
  }

  /// In the degrees of the state alone.
  void find_truncation(MembraneFlow& flow) {
    std::vector<Matrix> truncated;
    for (std::size_t a = 0; a < results.size(); ++a) {
      if (state_.vesicles[a].position.rows() != frozen_.state.vesicles[a].position.rows()) return;
      truncated.push_back(total_force(frozen_, solved_.fields.vesicles[a], a));
    }
    const std::vector<Matrix> velocities = velocities_of(flow, truncated);
    for (std::size_t a = 0; a < results.size(); ++a) {
      results[a].velocity_truncation = results[a].velocity_of_shape - velocities[a];
    }
  }

  static void remove_mean(const Membrane& membrane, Vector& coefficients) {
    const Matrix weighted = membrane.weighted(membrane.fine.synthesize(Matrix(coefficients)));
    const double mean = weighted(0, 0) / membrane.fine.analyze(membrane.surface.area_element)(0, 0);
    coefficients[0] -= mean * std::sqrt(4.0 * std::numbers::pi);
  }

  const FrozenState& frozen_;
  NumericalSettings settings_;
  Instruments instruments_;
  State state_;
  SolvedFields solved_;
  std::vector<ElectricMembrane> in_field_;
  std::vector<FlowMembrane> in_flow_;

 public:
  std::vector<CheckFields> results;
};

}  // namespace

std::vector<CheckFields> coupled_check_fields(const FrozenState& frozen, const CheckContents& contents,
                                              const std::vector<Matrix>& forces, const std::vector<int>& orders) {
  const auto start = std::chrono::steady_clock::now();
  CoupledFrozenSolver solver(frozen, contents, orders);
  if (contents.electric) solver.take_prescribed();
  if (contents.steady) solver.solve_steady();
  if (contents.flow) solver.solve_flow(forces);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (CheckFields& result : solver.results) result.seconds = seconds;
  return std::move(solver.results);
}

}  // namespace vehd
