#pragma once

#include <vector>

#include "tests/support/runs.hpp"

/// Models and states of several vesicles.
namespace vehd::testing {

/// n vesicles like the one of this model.
inline Model with_vesicles(Model model, std::size_t n) {
  model.vesicles.assign(n, VesicleModel(model.vesicles.front()));
  return model;
}

inline State at_rest(const std::vector<Matrix>& positions) {
  State state;
  for (const Matrix& position : positions) state.vesicles.push_back(at_rest(position).vesicles.front());
  return state;
}

/// Discretisation with spaces of the degrees of the positions.
inline Discretisation discretisation_of(const std::vector<Matrix>& positions, const NumericalSettings& settings = {},
                                        const Symmetry& symmetry = {}) {
  std::vector<ResolutionLevel> levels;
  for (const Matrix& position : positions) levels.push_back({order_of(position.rows()), 1.0});
  return {settings, symmetry, levels};
}

inline State start(const Model& model, const Discretisation& discretisation, const std::vector<Matrix>& positions,
                   double dt, bool steady = false) {
  std::vector<StartMembrane> membranes;
  for (const Matrix& position : positions) membranes.push_back({position, {.steady = steady}});
  Instruments instruments;
  return initial_state(model, discretisation, membranes, dt, instruments);
}

inline SolvedFields solved(const Model& model, const Discretisation& discretisation, const State& state) {
  Instruments instruments;
  return solve_fields(model, discretisation, state, instruments);
}

/// Velocity of the centre of a sphere, from the coefficients of the velocity about its centre.
inline Vector3 translation(const Matrix& velocity) {
  return velocity.row(0).transpose() / std::sqrt(4.0 * std::numbers::pi);
}

}  // namespace vehd::testing
