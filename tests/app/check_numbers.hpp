#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "bie/comparison/check_input.hpp"

/// Data that the boundary-integral side passes to the finite elements, to be damaged.
struct CheckNumbers {
  vehd::CheckProblem problem;
  int order, high_order;  ///< for all vesicles
  std::vector<vehd::CheckFields> bie, high;

  CheckNumbers(vehd::CheckProblem given, int order_of_state, int other_order)
      : problem(std::move(given)), order(order_of_state), high_order(other_order) {
    solve(problem.frozen);
  }

  /// Computes the fields from this state, as code with wrong coefficients, data or conditions would.
  void solve(const vehd::FrozenState& state) {
    bie = solved(state, order);
    high = solved(state, high_order);
  }
  [[nodiscard]] std::vector<vehd::CheckFields> solved(const vehd::FrozenState& state, int degree) const {
    vehd::CheckProblem with_state = problem;
    with_state.frozen = state;
    return vehd::check_fields(with_state, std::vector<int>(problem.forces.size(), degree));
  }
  /// Replaces the numbers of the snapshot by the computed ones.
  void store_found() {
    for (std::size_t a = 0; a < bie.size(); ++a) {
      vehd::VesicleFields& stored = problem.frozen.fields.vesicles[a];
      stored.velocity = bie[a].velocity_of_shape;
      stored.force_bending = bie[a].force_bending;
      stored.force_tension = bie[a].force_tension;
      stored.force_electric = bie[a].force_electric;
      stored.tension = bie[a].tension;
      stored.charge = bie[a].charge;
      stored.potential = bie[a].potential_of_charges;
    }
  }
  void write(const std::filesystem::path& file) const { vehd::write_check_input(file, {problem, bie, high}); }
};
