#pragma once

#include <stdexcept>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/discretisation.hpp"
#include "bie/stepping/model.hpp"
#include "bie/stepping/stepper.hpp"

/// Models of the tests and short runs of them.
namespace vehd::testing {

inline Model relaxation_model(double modulus) {
  Model model;
  model.bending = BendingParameters{modulus};
  return model;
}

inline Model shear_model() {
  Model model = relaxation_model(0.1);
  model.flow = shear_flow(1.0);
  return model;
}

/// Example 2 of the paper.
inline Model field_model() {
  Model model = relaxation_model(0.1);
  model.electric = ElectricParameters{{0.0, 0.0, 1.0}, 1.0, 2.0, 1.0};
  model.charging = ChargingParameters{1.0, 5.0};
  return model;
}

inline Discretisation discretisation_of(int order) {
  NumericalSettings settings;
  settings.order = order;
  return Discretisation(settings);
}

/// Solves that go on to rounding. With those of a run, what two solvers make of one step differs by where each of them
/// stopped, on one processor here and on another there.
inline NumericalSettings solved_to_rounding(int order) {
  NumericalSettings settings;
  settings.order = order;
  settings.flow_tolerance = 1e-12;
  settings.electric_tolerance = 1e-13;
  settings.constraint_tolerance = 1e-12;
  settings.curvature_tolerance = 1e-9;
  settings.strain_tolerance = 1e-10;
  return settings;
}

/// With the symmetry that the shape and the model have.
inline Discretisation symmetric_discretisation(const Model& model, const Matrix& position, int time_order = 1) {
  NumericalSettings settings;
  settings.order = order_of(position.rows());
  settings.time_order = time_order;
  State shape;
  shape.position = position;
  shape.area_strain = Vector::Zero(position.rows());
  return Discretisation(settings, find_symmetry(model, shape));
}

inline State start(const Model& model, const Discretisation& discretisation, const Matrix& position, double dt) {
  Instruments instruments;
  return initial_state(model, discretisation, position, {}, dt, instruments);
}

inline Evaluation evaluated(const Model& model, const Discretisation& discretisation, const State& state) {
  Instruments instruments;
  return evaluate(model, discretisation, state, instruments);
}

inline StepResult stepped(const Model& model, const Discretisation& discretisation, const State& state, double dt) {
  Instruments instruments;
  return step(model, discretisation, state, evaluate(model, discretisation, state, instruments), dt, instruments);
}

/// n_steps steps of size dt, calling `watch` with each new state.
template <typename Watch>
State run(const Model& model, const Discretisation& discretisation, State state, double dt, int n_steps,
          const Watch& watch) {
  for (int i = 0; i < n_steps; ++i) {
    const StepResult result = stepped(model, discretisation, state, dt);
    if (!result.accepted) throw std::runtime_error(result.reason);
    state = result.state;
    watch(state);
  }
  return state;
}

inline State run(const Model& model, const Discretisation& discretisation, State state, double dt, int n_steps) {
  return run(model, discretisation, std::move(state), dt, n_steps, [](const State&) {});
}

}  // namespace vehd::testing
