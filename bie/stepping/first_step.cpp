#include "bie/stepping/first_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/physics/electric.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {
namespace {

/// At which a pump charges a membrane without V_m and field, whose potential has no size yet to compare with.
double pumped_rate(const EvolutionSetup& setup, const VesicleModel& model, const VesicleState& vesicle, double radius) {
  if (!model.pump || !setup.model.electric->field.isZero(0.0) || !vesicle.transmembrane_potential.isZero(0.0)) {
    return 0.0;
  }
  const double series = series_conductivity(electric_parameters(setup.model, model));
  return (model.charging.conductance + series / radius) / model.charging.capacitance;
}

/// Rate at which one membrane changes at the start, relative to its size.
double starting_rate(const EvolutionSetup& setup, const VesicleModel& model, const VesicleState& vesicle,
                     const VesicleFields& fields, const VesicleSolution& solution) {
  const double radius = std::sqrt(vesicle.reference_area / (4.0 * std::numbers::pi));
  double rate = 0.0;
  // Degree 0 carries the membrane along and changes nothing of it.
  const Matrix& velocity = fields.velocity;
  if (velocity.size() > 0) rate = velocity.bottomRows(velocity.rows() - 1).norm() / radius;
  const Vector& of_potential = solution.rate.transmembrane_potential;
  if (of_potential.size() > 0) {
    if (const double pumped = pumped_rate(setup, model, vesicle, radius); pumped > 0.0) return std::max(rate, pumped);
    const double scale = potential_scale(*setup.model.electric, radius, vesicle.transmembrane_potential.norm());
    rate = std::max(rate, of_potential.norm() / scale);
  }
  return rate;
}

}  // namespace

double first_step(const EvolutionSetup& setup, const Evaluation& evaluation, const State& state) {
  double rate = 0.0;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    rate = std::max(rate, starting_rate(setup, setup.model.vesicles[a], state.vesicles[a],
                                        evaluation.fields.vesicles[a], evaluation.vesicles[a]));
  }
  const double share =
      thresholds::first_step_share * std::pow(setup.control.tolerance, 1.0 / setup.settings.time_order);
  return rate > 0.0 ? std::min(share / rate, setup.control.largest) : setup.control.largest;
}

}  // namespace vehd
