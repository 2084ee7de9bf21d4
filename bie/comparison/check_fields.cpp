#include "bie/comparison/check_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "bie/physics/effects/bending.hpp"
#include "bie/physics/effects/tension.hpp"
#include "bie/physics/electric.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/physics/membrane_flow.hpp"
#include "bie/physics/volume_fields.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/solve/flow_equations.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Local forces on a membrane, for which no layers are assembled.
/// @param position  coefficients of x in its degree, [n_coefficients x 3]
LocalForces forces_on(const FrozenState& frozen, const Membrane& membrane, const Matrix& position,
                      std::size_t vesicle) {
  const VesicleModel& model = frozen.model.vesicles[vesicle];
  LocalForces forces;
  forces.order = membrane.fine.order();
  if (model.bending) forces.bending = membrane.fine.analyze(bending_force(*model.bending, membrane));
  for (const auto& effect : model.effects) {
    if (effect->spontaneous_curvature() == 0.0) continue;
    Forcing forcing{Matrix::Zero(membrane.surface.n_points(), 3), {}};
    effect->add({membrane, position, frozen.state.time}, forcing);
    forces.curvature = membrane.fine.analyze(forcing.force);
  }
  return forces;
}

}  // namespace

LocalForces local_forces(const FrozenState& frozen, int order, std::size_t vesicle) {
  const Matrix position = resize_order(frozen.state.vesicles[vesicle].position, order);
  const SphereTransform fine(order, make_grid(frozen.settings.upsampling * order));
  Surface surface = make_surface(fine, position);
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  const Membrane membrane{fine, std::move(surface), {}, radius, SymmetrySubspace({}, order)};
  return forces_on(frozen, membrane, position, vesicle);
}

namespace {

/// Resizes each membrane to its own degree.
State resized_to(State state, const std::vector<int>& orders) {
  for (std::size_t a = 0; a < orders.size(); ++a) {
    state.vesicles[a] = resized(std::move(state.vesicles[a]), orders[a]);
  }
  return state;
}

Discretisation discretisation_of(const FrozenState& frozen, const std::vector<int>& orders) {
  NumericalSettings settings = frozen.settings;
  std::vector<ResolutionLevel> levels;
  for (std::size_t a = 0; a < orders.size(); ++a) {
    const NumericalSettings own = settings_at(frozen, orders[a], a);
    settings.flow_tolerance = std::min(settings.flow_tolerance, own.flow_tolerance);
    settings.electric_tolerance = std::min(settings.electric_tolerance, own.electric_tolerance);
    levels.push_back({orders[a], 1.0});
  }
  return {settings, frozen.symmetry, levels};
}

/// The frozen problem of all membranes at given degrees.
class FrozenSolver {
 public:
  FrozenSolver(const CheckProblem& problem, const std::vector<int>& orders)
      : problem_(problem),
        frozen_(problem.frozen),
        state_(resized_to(frozen_.state, orders)),
        discretisation_(discretisation_of(frozen_, orders)),
        solved_(solve_fields(compared_model(frozen_, problem.contents), discretisation_, state_, instruments_)),
        results(orders.size()) {
    for (std::size_t a = 0; a < orders.size(); ++a) {
      results[a].order = orders[a];
      if (problem.contents.electric) in_field_.push_back({electric_at(frozen_, a), membrane(a)});
      if (problem.contents.flow) in_flow_.push_back({flow_parameters(frozen_.model, model(a)), membrane(a)});
    }
  }

  void take_prescribed() {
    for (std::size_t a = 0; a < results.size(); ++a) {
      const VesicleFields& of = fields(a);
      results[a].charge = of.charge;
      results[a].force_electric = of.force_electric;
      results[a].potential_rate = charging_rate(a);
      results[a].rate_truncation = rate_truncation(a);
      results[a].potential_of_charges = of.potential;
      results[a].free_charge_rate = solved_.vesicles[a].rate.free_charge;
    }
    if (problem_.samples.points.rows() > 0) sample_potential(results.front());
  }

  void solve_steady() {
    std::vector<ChargingMembrane> membranes;
    for (std::size_t a = 0; a < results.size(); ++a) membranes.push_back({in_field_[a], model(a).charging});
    std::vector<Vector> potentials(results.size()), charges(results.size());
    const Interaction& interaction = *solved_.interaction;
    require_converged(steady_potentials(membranes, interaction, electric_tolerance(), potentials),
                      "steady membrane potentials");
    const std::vector<SecondKindSolution> densities = charge_densities(potentials);
    const std::vector<Vector> of_others = potentials_of_others(in_field_, interaction, potentials, densities);
    for (const std::size_t a : interaction.partition().local_indices(results.size())) {
      const ElectricTraces traces =
          electric_traces(in_field_[a].electric, membrane(a), potentials[a], densities[a], of_others[a]);
      charges[a] = membrane(a).fine.analyze(traces.charge);
    }
    interaction.gather_potentials(charges);
    for (std::size_t a = 0; a < results.size(); ++a) {
      if (model(a).charging.conductance == 0.0) remove_mean(membrane(a), potentials[a]);
      results[a].steady_charge = std::move(charges[a]);
      results[a].steady_potential = std::move(potentials[a]);
    }
  }

  void solve_flow() {
    MembraneFlow flow(in_flow_, *solved_.interaction);
    std::vector<Matrix> given, own, truncated;
    for (std::size_t a = 0; a < results.size(); ++a) {
      CheckFields& result = results[a];
      take_flow_of_shape(a);
      given.push_back(resize_order(problem_.forces[a], result.order));
      if (result.force_electric.size() > 0) {
        const Matrix stored = resize_order(frozen_.fields.vesicles[a].force_electric, result.order);
        own.push_back(given[a] + stored - result.force_electric);
      }
      if (is_of_state(a)) truncated.push_back(total_force(frozen_, fields(a), a));
    }
    take(&CheckFields::velocity, velocities_of(flow, given));
    if (!own.empty()) take(&CheckFields::velocity_own_force, velocities_of(flow, own));
    if (truncated.size() == results.size()) {
      take(&CheckFields::velocity_truncation, velocities_of(flow, truncated));
      for (CheckFields& of : results) of.velocity_truncation = of.velocity_of_shape - of.velocity_truncation;
    }
    if (problem_.samples.points.rows() > 0) sample_velocity(results.front(), given.front());
  }

 private:
  [[nodiscard]] const VesicleModel& model(std::size_t a) const { return frozen_.model.vesicles[a]; }
  [[nodiscard]] const Membrane& membrane(std::size_t a) const { return *solved_.vesicles[a].membrane; }
  [[nodiscard]] const VesicleFields& fields(std::size_t a) const { return solved_.fields.vesicles[a]; }
  [[nodiscard]] double electric_tolerance() const { return discretisation_.settings().electric_tolerance; }
  /// Whether a vesicle is solved at the degree of the state.
  [[nodiscard]] bool is_of_state(std::size_t a) const {
    return state_.vesicles[a].position.rows() == frozen_.state.vesicles[a].position.rows();
  }

  [[nodiscard]] Vector charging_rate(std::size_t a) const {
    const Vector& rate = solved_.vesicles[a].rate.transmembrane_potential;
    const Vector& varies = membrane(a).material.capacitance;
    if (varies.size() == 0 || relaxes_charge(frozen_.model)) return rate;
    const Vector current = varies.cwiseProduct(Vector(membrane(a).fine.synthesize(rate)));
    return membrane(a).fine.analyze(current) / model(a).charging.capacitance;
  }
  [[nodiscard]] Vector rate_truncation(std::size_t a) const {
    if (!model(a).reaction || !is_of_state(a)) return {};
    const SphereTransform& fine = membrane(a).fine;
    const ChargingMembrane porous{in_field_[a], model(a).charging, model(a).reaction.get()};
    const Vector lost = membrane_current(porous, state_.vesicles[a].poration).conductance -
                        Vector(fine.synthesize(fields(a).conductance));
    const Vector potential = fine.synthesize(transmembrane_potential(state_.vesicles[a], fields(a)));
    return -fine.analyze(lost.cwiseProduct(potential)) / model(a).charging.capacitance;
  }

  /// At the degree of the state, local forces as in the run; otherwise at twice the degree of the state or higher, as
  /// f_b has four derivatives of x and its change by a few degrees underestimates the error.
  [[nodiscard]] LocalForces local_forces_beside(std::size_t a) const {
    const Matrix& position = state_.vesicles[a].position;
    if (is_of_state(a)) return forces_on(frozen_, membrane(a), position, a);
    const int solved = order_of(position.rows()), of_state = order_of(frozen_.state.vesicles[a].position.rows());
    const int order = std::max(2 * of_state, solved);
    return order == solved ? forces_on(frozen_, membrane(a), position, a) : local_forces(frozen_, order, a);
  }

  void take_flow_of_shape(std::size_t a) {
    CheckFields& result = results[a];
    LocalForces local = local_forces_beside(a);
    result.force_order = local.order;
    result.force_bending = std::move(local.bending);
    result.force_curvature = std::move(local.curvature);
    result.force_tension = fields(a).force_tension;
    result.tension = fields(a).tension;
    result.velocity_of_shape = fields(a).velocity;
    FlowParameters parameters = in_flow_[a].parameters;
    if (parameters.undulations) {
      result.dilation = dilation(membrane(a), fields(a).velocity);
      parameters.undulations.reset();
    }
    result.tension_is_free = uniform_tension_is_free(parameters, membrane(a));
  }

  /// @param potentials  V_m of each vesicle
  [[nodiscard]] std::vector<SecondKindSolution> charge_densities(const std::vector<Vector>& potentials) const {
    std::vector<SecondKindSolution> densities =
        solve_second_kind(in_field_, *solved_.interaction, weighted_fluxes(in_field_, *solved_.interaction, potentials),
                          electric_tolerance());
    require_converged(densities.front().report, "charge densities, Eq. (12)");
    return densities;
  }

  [[nodiscard]] static Matrix weighted(const Membrane& membrane, const Matrix& coefficients) {
    return membrane.weighted(membrane.fine.synthesize(coefficients));
  }

  /// Velocities due to the background flow and forces, coefficients; those of images follow from their originals.
  [[nodiscard]] std::vector<Matrix> velocities_of(MembraneFlow& flow, const std::vector<Matrix>& forces) const {
    std::vector<Matrix> densities, background;
    for (std::size_t a = 0; a < results.size(); ++a) {
      densities.push_back(weighted(membrane(a), forces[a]));
      background.push_back(state_.vesicles[a].position * flow_gradient(frozen_).transpose());
    }
    std::vector<Matrix> velocities = flow.velocities(densities, background);
    solved_.interaction->gather_vectors(velocities);
    return velocities;
  }
  void take(Matrix CheckFields::*field, std::vector<Matrix> of_each) {
    for (std::size_t a = 0; a < results.size(); ++a) results[a].*field = std::move(of_each[a]);
  }

  void sample_potential(CheckFields& result) {
    const Vector& potential = transmembrane_potential(state_.vesicles.front(), fields(0));
    const Vector charge = relaxes_charge(frozen_.model) ? Vector(weighted(membrane(0), result.charge))
                                                        : conductivity_contrast(in_field_[0].electric) *
                                                              charge_densities({potential})[0].weighted;
    const PotentialSources sources{in_field_[0].electric.field, potential, charge, frozen_.model.wall};
    const auto at = [&](const Matrix& points) {
      PotentialSamples found =
          potential_at(points, Side::principal_value, state_.vesicles.front().position, sources, {}, instruments_);
      return SampleValues{std::move(found.potential), std::move(found.side)};
    };
    result.sample_potential = where_possible(problem_.samples.points, 1, result.is_inside, at);
  }

  void sample_velocity(CheckFields& result, const Matrix& force) {
    const auto background = [gradient = flow_gradient(frozen_)](const Vector3& x) -> Vector3 { return gradient * x; };
    const VelocitySources sources{frozen_.model.viscosity,  background,      weighted(membrane(0), force),
                                  model(0).viscosity_ratio, result.velocity, frozen_.model.wall};
    const auto at = [&](const Matrix& points) {
      VelocitySamples found = velocity_at(points, state_.vesicles.front().position, sources, {}, instruments_);
      return SampleValues{std::move(found.velocity), std::move(found.side)};
    };
    result.sample_velocity = where_possible(problem_.samples.points, 3, result.is_inside, at);
  }

  static void remove_mean(const Membrane& membrane, Vector& coefficients) {
    const double area = membrane.fine.analyze(membrane.surface.area_element)(0, 0);
    coefficients[0] -= weighted(membrane, coefficients)(0, 0) / area * coefficient_of_one;
  }

  const CheckProblem& problem_;
  const FrozenState& frozen_;
  Instruments instruments_;
  State state_;
  Discretisation discretisation_;
  SolvedFields solved_;
  std::vector<ElectricMembrane> in_field_;
  std::vector<FlowMembrane> in_flow_;

 public:
  std::vector<CheckFields> results;
};

}  // namespace

std::vector<CheckFields> check_fields(const CheckProblem& problem, const std::vector<int>& orders) {
  const auto start = std::chrono::steady_clock::now();
  FrozenSolver solver(problem, orders);
  if (problem.contents.electric) solver.take_prescribed();
  if (problem.contents.steady) solver.solve_steady();
  if (problem.contents.flow) solver.solve_flow();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  for (CheckFields& result : solver.results) result.seconds = seconds;
  return std::move(solver.results);
}

}  // namespace vehd
