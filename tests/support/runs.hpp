#pragma once

#include <algorithm>
#include <stdexcept>

#include "bie/physics/model.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/initial_state.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "bie/stepping/time/step_control.hpp"
#include "tests/support/fields.hpp"

/// Models for the tests and short runs of them.
namespace vehd::testing {

inline Model relaxation_model(double modulus) {
  Model model;
  model.vesicles[0].bending = BendingParameters{modulus};
  return model;
}

inline Model shear_model() {
  Model model = relaxation_model(0.1);
  model.flow = shear_flow(1.0);
  return model;
}

/// Sets a field around one vesicle with this inside and this membrane.
inline void set_electric(Model& model, const ElectricParameters& electric, const ChargingParameters& charging) {
  model.electric = AppliedField{electric.field, electric.conductivity_out, electric.permittivity, electric.waveform};
  model.vesicles[0].inside = {electric.conductivity_in, electric.permittivity_ratio};
  model.vesicles[0].charging = charging;
}

/// Example 2 of the paper.
inline Model field_model() {
  Model model = relaxation_model(0.1);
  set_electric(model, {{0.0, 0.0, 1.0}, 1.0, 2.0, 1.0}, {1.0, 5.0});
  return model;
}

inline Discretisation discretisation_of(int order) {
  NumericalSettings settings;
  settings.order = order;
  return Discretisation(settings);
}

/// Sets tolerances to rounding. With the tolerances of a run, the results of two solvers for one step differ by where
/// each of them stopped, which depends on the processor.
inline void solve_to_rounding(NumericalSettings& settings) {
  settings.flow_tolerance = 1e-12;
  settings.electric_tolerance = 1e-13;
  settings.constraint_tolerance = 1e-12;
  settings.curvature_tolerance = 1e-9;
  settings.strain_tolerance = 1e-10;
}

inline NumericalSettings solved_to_rounding(int order) {
  NumericalSettings settings;
  settings.order = order;
  solve_to_rounding(settings);
  return settings;
}

/// Settings with solvers that add no error to a comparison; the constraints are held as in a run.
inline NumericalSettings tight_settings(int time_order) {
  NumericalSettings settings;
  settings.time_order = time_order;
  settings.flow_tolerance = 1e-11;
  settings.electric_tolerance = 1e-12;
  return settings;
}

/// A state of one membrane without charge, strain or references.
inline State at_rest(const Matrix& position) {
  State state;
  VesicleState& vesicle = state.vesicles.emplace_back();
  vesicle.position = position;
  vesicle.area_strain = Vector::Zero(position.rows());
  return state;
}

/// Indices of the coefficients that can differ from zero in a scalar that is its own image.
inline std::vector<Index> scalar_entries(const Symmetry& symmetry, int order) {
  return SymmetrySubspace(symmetry, order).scalars();
}

/// Discretisation with the symmetry that the shape and the model have.
inline Discretisation symmetric_discretisation(const Model& model, const Matrix& position, int time_order = 1) {
  NumericalSettings settings;
  settings.order = order_of(position.rows());
  settings.time_order = time_order;
  return Discretisation(settings, find_symmetry(model, at_rest(position)));
}

inline State start(const Model& model, const Discretisation& discretisation, const Matrix& position, double dt) {
  Instruments instruments;
  return initial_state(model, discretisation, {StartMembrane{position}}, dt, instruments);
}

/// The evaluation of a state of one vesicle.
struct Evaluated {
  VesicleFields fields;
  VesicleDiagnostics diagnostics;
  VesicleSolution solution;
};

inline Evaluated evaluated(const Model& model, const Discretisation& discretisation, const State& state) {
  Instruments instruments;
  const Evaluation evaluation = evaluate(model, discretisation, state, instruments);
  return {evaluation.fields.vesicles[0], evaluation.diagnostics.vesicles[0], evaluation.vesicles[0]};
}

inline StepAttempt stepped(const Model& model, const Discretisation& discretisation, const State& state, double dt) {
  Instruments instruments;
  return attempt_step({model, discretisation, state, solve_fields(model, discretisation, state, instruments)}, dt,
                      instruments);
}

/// Takes n_steps steps of size dt, calling `watch` with each new state.
template <typename Watch>
State run(const Model& model, const Discretisation& discretisation, State state, double dt, int n_steps,
          const Watch& watch) {
  for (int i = 0; i < n_steps; ++i) {
    const StepAttempt result = stepped(model, discretisation, state, dt);
    if (!result.accepted) throw std::runtime_error(result.reason);
    state = result.state;
    watch(state);
  }
  return state;
}

inline State run(const Model& model, const Discretisation& discretisation, State state, double dt, int n_steps) {
  return run(model, discretisation, std::move(state), dt, n_steps, [](const State&) {});
}

/// Largest difference of x and V_m of two states of one vesicle.
inline double largest_difference(const State& a, const State& b) {
  const VesicleState& one = a.vesicles[0];
  const VesicleState& other = b.vesicles[0];
  double difference = max_difference(one.position, other.position);
  if (one.transmembrane_potential.size() > 0) {
    difference = std::max(difference, max_difference(one.transmembrane_potential, other.transmembrane_potential));
  }
  return difference;
}

/// Largest difference per step between the final states of n steps from the same shape in two discretisations.
inline double difference_per_step(const Model& model, const Matrix& position, const Discretisation& one,
                                  const Discretisation& other, double dt, int n_steps) {
  const State a = run(model, one, start(model, one, position, dt), dt, n_steps);
  const State b = run(model, other, start(model, other, position, dt), dt, n_steps);
  return largest_difference(a, b) / n_steps;
}

/// Largest difference per step with and without use of the symmetry that is found.
inline double difference_with_symmetry(const Model& model, const Matrix& position, double dt, int n_steps) {
  const NumericalSettings settings = solved_to_rounding(order_of(position.rows()));
  const Discretisation reduced(settings, find_symmetry(model, at_rest(position))), full(settings, {});
  return difference_per_step(model, position, reduced, full, dt, n_steps);
}

}  // namespace vehd::testing
