#include "fem_check/membrane_condition.hpp"

#include <algorithm>
#include <string>

namespace vehd::fem_check {

namespace {

void require(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument(what);
}

bool all_positive(const PerVesicle<double>& of) {
  return std::all_of(of.values().begin(), of.values().end(), [](double value) { return value > 0.0; });
}

bool none_negative(const PerVesicle<double>& of) {
  return std::all_of(of.values().begin(), of.values().end(), [](double value) { return value >= 0.0; });
}

}  // namespace

void require_valid(const PotentialProblem& problem) {
  std::vector<double> conductivities = problem.conductivity_in.values();
  conductivities.push_back(problem.conductivity_out);
  for (const double sigma : conductivities) {
    require(sigma > 0.0, "conductivity is " + std::to_string(sigma) + "; must be positive");
  }
  if (const auto* prescribed = std::get_if<PrescribedJump>(&problem.membrane)) {
    require(bool(prescribed->potential_jump), "the prescribed transmembrane potential is missing");
  } else if (const auto* steady = std::get_if<SteadyMembrane>(&problem.membrane)) {
    require(none_negative(steady->conductance), "membrane conductance is negative");
  } else if (const auto* charged = std::get_if<ChargedMembrane>(&problem.membrane)) {
    require(all_positive(charged->capacitance), "membrane capacitance must be positive");
    require(bool(charged->inner_charge), "the charge of the inner face is missing");
  } else {
    const auto& charging = std::get<ChargingMembrane>(problem.membrane);
    require(all_positive(charging.capacitance), "membrane capacitance must be positive");
    require(none_negative(charging.conductance), "membrane conductance is negative");
    require(charging.time_step > 0.0 && charging.steps >= 1,
            "time step and number of steps of charging must be positive");
    require(bool(charging.initial), "the initial transmembrane potential is missing");
  }
}

PerVesicle<double> membrane_coefficient(const PotentialProblem& problem, int n_vesicles) {
  if (const auto* steady = std::get_if<SteadyMembrane>(&problem.membrane)) return steady->conductance;
  if (const auto* charged = std::get_if<ChargedMembrane>(&problem.membrane)) return charged->capacitance;
  if (const auto* charging = std::get_if<ChargingMembrane>(&problem.membrane)) {
    return per_vesicle(n_vesicles, [&](int vesicle) {
      return charging->conductance[vesicle] + charging->capacitance[vesicle] / charging->time_step;
    });
  }
  return 0.0;
}

bool mean_is_free(const PotentialProblem& problem, int vesicle) {
  const auto* steady = std::get_if<SteadyMembrane>(&problem.membrane);
  return steady != nullptr && steady->conductance[vesicle] == 0.0;
}

/// The degrees of freedom on γ are those of the better conductor, and the other side is tied to them: the jump is then
/// carried by the side whose energy is small.
Fixed fixed_nodes(const PotentialProblem& problem, int n_vesicles) {
  Fixed fixed;
  if (std::holds_alternative<PrescribedJump>(problem.membrane)) {
    fixed.tie = per_vesicle(n_vesicles, [&](int vesicle) {
      return problem.conductivity_in[vesicle] > problem.conductivity_out ? Tie::outer_follows_inner
                                                                         : Tie::inner_follows_outer;
    });
  }
  fixed.outer = problem.outer.kind == OuterCondition::Kind::dirichlet;
  fixed.wall = problem.wall == WallField::electrode;
  // With given fluxes the constant outside is undetermined; a node far from γ fixes it.
  fixed.outer_value = problem.outer.kind == OuterCondition::Kind::neumann;
  for (int vesicle = 0; vesicle < n_vesicles; ++vesicle) {
    if (mean_is_free(problem, vesicle)) fixed.floating.push_back(vesicle);
  }
  return fixed;
}

Vector stored_current(const ChargingMembrane& charging, const SurfacePoints& points, Vector voltage) {
  for (Eigen::Index i = 0; i < voltage.size(); ++i) {
    voltage[i] *= charging.capacitance[points.vesicle[i]] / charging.time_step;
  }
  return voltage;
}

}  // namespace vehd::fem_check
