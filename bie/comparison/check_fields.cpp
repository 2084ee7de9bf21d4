#include "bie/comparison/check_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "bie/comparison/local_forces.hpp"
#include "bie/physics/charge_density.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/physics/volume_fields.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/space/membrane_at.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/state/resized.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

const VesicleState& membrane_of(const FrozenState& frozen) { return frozen.state.vesicles.front(); }
const VesicleModel& vesicle_of(const FrozenState& frozen) { return frozen.model.vesicles.front(); }

/// All values in one call; where that fails each point on its own, and NaN where none is found.
/// @param values  [n x components] of [n x 3] points; @throws ConvergenceError
Matrix where_possible(const Matrix& points, Index components, const std::function<Matrix(const Matrix&)>& values) {
  try {
    return values(points);
  } catch (const ConvergenceError&) {
    Matrix result = Matrix::Constant(points.rows(), components, std::numeric_limits<double>::quiet_NaN());
    for (Index i = 0; i < points.rows(); ++i) {
      try {
        result.row(i) = values(points.row(i));
      } catch (const ConvergenceError&) {
        // It stays unknown: another part of the membrane is as near, or the degree is too low for the shape.
      }
    }
    return result;
  }
}

/// The frozen problem on one membrane at one order.
class FrozenSolver {
 public:
  FrozenSolver(const FrozenState& frozen, const CheckContents& contents, int order)
      : frozen_(frozen),
        settings_(settings_at(frozen, order)),
        state_(resized(frozen.state, order)),
        position_(state_.vesicles.front().position),
        solved_(solve_fields(compared_model(frozen, contents), Discretisation(settings_, frozen.symmetry), state_,
                             instruments_)),
        membrane_(*solved_.vesicles.front().membrane) {
    result.order = order;
    if (contents.electric)
      electric_ = electric_parameters(frozen.model, vesicle_of(frozen)).at(frozen.state.time, Limit::after);
  }

  CheckFields result;

  void solve_prescribed(const Matrix& samples) {
    const VesicleFields& fields = solved_.fields.vesicles.front();
    result.charge = fields.charge;
    result.force_electric = fields.force_electric;
    result.potential_rate = charging_rate();
    result.rate_truncation = rate_truncation();
    const Vector& potential = transmembrane_potential(state_.vesicles.front(), fields);
    result.potential_of_charges = fields.potential;
    result.free_charge_rate = solved_.vesicles.front().rate.free_charge;
    const PotentialSources sources{electric_.field, potential, weighted_charge(potential)};
    keep_samples(result.sample_potential, where_possible(samples, 2, [&](const Matrix& points) {
                   const PotentialSamples at =
                       potential_at(points, Side::principal_value, position_, sources, {}, instruments_);
                   return with_sides(at.potential, at.side);
                 }));
  }

  void solve_steady() {
    const ChargingParameters& charging = vesicle_of(frozen_).charging;
    std::vector<Vector> potentials(1);
    require_converged(
        steady_potentials({{{electric_, membrane_}, charging}}, {}, settings_.electric_tolerance, potentials),
        "steady membrane potential");
    result.steady_potential = std::move(potentials.front());
    result.steady_charge = membrane_.fine.analyze(
        electric_traces(electric_, membrane_, result.steady_potential, charge_density(result.steady_potential)).charge);
    if (charging.conductance == 0.0) remove_mean(result.steady_potential);
  }

  void solve_flow(const Matrix& force, const Matrix& samples) {
    take_flow_of_shape();
    const Matrix padded = resize_order(force, result.order);
    result.velocity = velocity_of(padded);
    if (result.force_electric.size() > 0) {
      const Matrix stored = resize_order(frozen_.fields.vesicles.front().force_electric, result.order);
      result.velocity_own_force = velocity_of(padded + stored - result.force_electric);
    }
    const auto background = [gradient = flow_gradient(frozen_)](const Vector3& x) -> Vector3 { return gradient * x; };
    const VelocitySources sources{frozen_.model.viscosity, background, weighted(padded),
                                  vesicle_of(frozen_).viscosity_ratio, result.velocity};
    keep_samples(result.sample_velocity, where_possible(samples, 4, [&](const Matrix& points) {
                   const VelocitySamples at = velocity_at(points, position_, sources, {}, instruments_);
                   return with_sides(at.velocity, at.side);
                 }));
  }

 private:
  [[nodiscard]] Vector charging_rate() const {
    const Vector& rate = solved_.vesicles.front().rate.transmembrane_potential;
    const Vector& varies = membrane_.material.capacitance;
    if (varies.size() == 0 || relaxes_charge(frozen_.model)) return rate;
    const Vector current = varies.cwiseProduct(Vector(membrane_.fine.synthesize(rate)));
    return membrane_.fine.analyze(current) / vesicle_of(frozen_).charging.capacitance;
  }
  [[nodiscard]] Vector rate_truncation() const {
    const VesicleModel& vesicle = vesicle_of(frozen_);
    if (!vesicle.reaction || position_.rows() != membrane_of(frozen_).position.rows()) return {};
    const VesicleState& state = state_.vesicles.front();
    const VesicleFields& fields = solved_.fields.vesicles.front();
    const ChargingMembrane porous{{electric_, membrane_}, vesicle.charging, vesicle.reaction.get()};
    const Vector lost =
        membrane_current(porous, state.poration).conductance - Vector(membrane_.fine.synthesize(fields.conductance));
    const Vector potential = membrane_.fine.synthesize(transmembrane_potential(state, fields));
    return -membrane_.fine.analyze(lost.cwiseProduct(potential)) / vesicle.charging.capacitance;
  }
  /// Values with a last column that is 1 inside and 0 outside.
  static Matrix with_sides(const Matrix& values, const std::vector<Side>& sides) {
    Matrix joined(values.rows(), values.cols() + 1);
    joined.leftCols(values.cols()) = values;
    for (Index i = 0; i < values.rows(); ++i) {
      joined(i, values.cols()) = sides[static_cast<std::size_t>(i)] == Side::interior ? 1.0 : 0.0;
    }
    return joined;
  }
  /// Takes them apart again.
  template <typename Values>
  void keep_samples(Values& values, const Matrix& with_side) {
    values = with_side.leftCols(with_side.cols() - 1);
    result.is_inside.clear();
    for (const double side : with_side.col(with_side.cols() - 1)) result.is_inside.push_back(side == 1.0);
  }

  void take_flow_of_shape() {
    const VesicleFields& fields = solved_.fields.vesicles.front();
    LocalForces local = local_forces_beside(frozen_, membrane_, position_);
    result.force_order = local.order;
    result.force_bending = std::move(local.bending);
    result.force_curvature = std::move(local.curvature);
    result.force_tension = fields.force_tension;
    result.tension = fields.tension;
    result.tension_is_free = solved_.vesicles.front().is_sphere;
    result.velocity_of_shape = fields.velocity;
    if (position_.rows() != membrane_of(frozen_).position.rows()) return;
    result.velocity_truncation = fields.velocity - velocity_of(total_force(frozen_, fields));
  }

  /// J q of the state, coefficients.
  [[nodiscard]] Vector weighted_charge(const Vector& potential) const {
    if (relaxes_charge(frozen_.model)) return weighted(result.charge);
    return conductivity_contrast(electric_) * charge_density(potential).weighted;
  }

  [[nodiscard]] SecondKindSolution charge_density(const Vector& potential) const {
    SecondKindSolution density = solve_second_kind(
        membrane_, conductivity_contrast(electric_),
        weighted_field_flux(membrane_, electric_.field) + weighted_hypersingular(membrane_, potential),
        settings_.electric_tolerance);
    require_converged(density.report, "charge density, Eq. (12)");
    return density;
  }

  [[nodiscard]] Matrix weighted(const Matrix& coefficients) const {
    return membrane_.weighted(membrane_.fine.synthesize(coefficients));
  }
  /// Of the background flow and a force, coefficients.
  [[nodiscard]] Matrix velocity_of(const Matrix& force) const {
    Matrix driven = position_ * flow_gradient(frozen_).transpose();
    if (!membrane_.layers.stokes_single.empty()) {
      driven += membrane_.layers.stokes_single.apply(weighted(force)) / frozen_.model.viscosity;
    }
    return membrane_.velocity(std::move(driven));
  }

  void remove_mean(Vector& coefficients) const {
    const double mean = weighted(coefficients)(0, 0) / membrane_.fine.analyze(membrane_.surface.area_element)(0, 0);
    coefficients[0] -= mean * std::sqrt(4.0 * std::numbers::pi);
  }

  const FrozenState& frozen_;
  NumericalSettings settings_;
  Instruments instruments_;
  State state_;
  const Matrix& position_;
  SolvedFields solved_;
  const Membrane& membrane_;
  ElectricParameters electric_;
};

}  // namespace

Model compared_model(const FrozenState& frozen, const CheckContents& contents) {
  Model model = frozen.model;
  if (!contents.electric) model.electric.reset();
  model.mobile = contents.flow;
  return model;
}

NumericalSettings settings_at(const FrozenState& frozen, int order, std::size_t vesicle) {
  NumericalSettings settings = frozen.settings;
  if (order != order_of(frozen.state.vesicles[vesicle].position.rows())) {
    const NumericalSettings defaults;
    settings.flow_tolerance = std::min(settings.flow_tolerance, defaults.flow_tolerance);
    settings.electric_tolerance = std::min(settings.electric_tolerance, defaults.electric_tolerance);
  }
  settings.order = order;
  return settings;
}

namespace {

/// What the finite elements know about one vesicle alone.
void require_plain_charging(const FrozenState& frozen) {
  const auto refuse = [&](const char* what) {
    throw InputError(
        fmt::format("{}: has {}, which the finite-element check knows about one vesicle alone; accepted: "
                    "two without",
                    frozen.source, what));
  };
  if (relaxes_charge(frozen.model)) refuse("displacement currents");
  for (const VesicleModel& vesicle : frozen.model.vesicles) {
    if (vesicle.reaction || vesicle.by_place || vesicle.pump) {
      refuse("a membrane that porates or differs from place to place");
    }
  }
}

}  // namespace

CheckContents check_contents(const FrozenState& frozen) {
  const Model& model = frozen.model;
  CheckContents contents;
  contents.flow = model.mobile;
  for (const VesicleModel& vesicle : model.vesicles) {
    if (contents.flow && !(vesicle.viscosity_ratio > 0.0)) {
      throw InputError(fmt::format("{}: the viscosity inside is {:g}; the finite-element check needs it above zero",
                                   frozen.source, vesicle.viscosity_ratio * model.viscosity));
    }
  }
  if (model.electric) {
    std::vector<double> conductivities;
    for (const VesicleModel& vesicle : model.vesicles) conductivities.push_back(vesicle.inside.conductivity);
    conductivities.push_back(model.electric->conductivity);
    for (const double sigma : conductivities) {
      if (sigma > 0.0) continue;
      throw InputError(fmt::format("{}: a conductivity is {:g}; the finite-element check needs both above zero",
                                   frozen.source, sigma));
    }
    contents.steady = !applied_field(frozen).isZero(0.0);
    contents.electric = contents.steady || present_pump(frozen) != 0.0;
    for (std::size_t a = 0; a < model.vesicles.size(); ++a) {
      const VesicleState& membrane = frozen.state.vesicles[a];
      const VesicleModel& vesicle = model.vesicles[a];
      const bool charged = !membrane.transmembrane_potential.isZero(0.0) || !membrane.free_charge.isZero(0.0);
      contents.electric = contents.electric || charged;
      if (vesicle.reaction || membrane.material.conductance.size() > 0 || vesicle.pump) contents.steady = false;
    }
    if (model.vesicles.size() > 1) require_plain_charging(frozen);
  }
  if (!contents.electric && !contents.flow) {
    throw InputError(fmt::format("{}: neither a field nor a flow at time {:g}: there is nothing to compare",
                                 frozen.source, frozen.state.time));
  }
  return contents;
}

Vector3 applied_field(const FrozenState& frozen) {
  if (!frozen.model.electric) return Vector3::Zero();
  return electric_parameters(frozen.model, vesicle_of(frozen)).at(frozen.state.time, Limit::after).field;
}

double present_pump(const FrozenState& frozen) {
  if (!frozen.model.electric) return 0.0;
  return electric_parameters(frozen.model, vesicle_of(frozen)).at(frozen.state.time, Limit::after).pump;
}

Matrix3 flow_gradient(const FrozenState& frozen) {
  if (!frozen.model.flow) return Matrix3::Zero();
  return frozen.model.flow->waveform.at(frozen.state.time, Limit::after) * frozen.model.flow->gradient;
}

Matrix total_force(const FrozenState& frozen, const VesicleFields& fields, std::size_t vesicle) {
  const Matrix& position = frozen.state.vesicles[vesicle].position;
  Matrix force = Matrix::Zero(position.rows(), 3);
  if (fields.force_bending.size() > 0) force += fields.force_bending;
  if (fields.force_tension.size() > 0) force += fields.force_tension;
  if (fields.force_electric.size() > 0) force -= fields.force_electric;
  if (fields.force_contact.size() > 0) force += fields.force_contact;
  Model others = frozen.model;
  others.flow.reset();
  const auto effects = explicit_effects(others, others.vesicles[vesicle]);
  if (effects.empty()) return force;

  // The run file stores no other forces: they follow from the shape and the time.
  Instruments instruments;
  const MembraneSpace space(settings_at(frozen, order_of(position.rows()), vesicle), frozen.symmetry);
  const Membrane membrane = membrane_at(space, position, {}, 1.0, instruments);
  for (const auto& effect : effects) {
    Forcing forcing{Matrix::Zero(membrane.surface.n_points(), 3), Matrix::Zero(position.rows(), 3)};
    effect->add({membrane, position, frozen.state.time}, forcing);
    if (!forcing.velocity.isZero(0.0)) {
      throw InputError(fmt::format("{}: the finite-element check knows linear background flows only, not: {}",
                                   frozen.source, effect->description().name));
    }
    force += membrane.fine.analyze(forcing.force);
  }
  return force;
}

CheckFields check_fields(const FrozenState& frozen, const CheckContents& contents, const Matrix& force, int order,
                         const Matrix& samples) {
  const auto start = std::chrono::steady_clock::now();
  FrozenSolver solver(frozen, contents, order);
  if (contents.electric) solver.solve_prescribed(samples);
  if (contents.steady) solver.solve_steady();
  if (contents.flow) solver.solve_flow(force, samples);
  solver.result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return std::move(solver.result);
}

}  // namespace vehd
