#include "bie/comparison/check_fields.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include "bie/physics/electric.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/physics/volume_fields.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/space/membrane_at.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

const VesicleState& membrane_of(const FrozenState& frozen) { return frozen.state.vesicles.front(); }
const VesicleModel& vesicle_of(const FrozenState& frozen) { return frozen.model.vesicles.front(); }

MembraneSpace space_at(const FrozenState& frozen, int order) {
  NumericalSettings settings;
  settings.order = order;
  return {settings, frozen.symmetry};
}

LayerSelection layers_for(const CheckContents& contents, const VesicleModel& vesicle) {
  LayerSelection selection;
  selection.laplace_single = selection.laplace_double = selection.laplace_adjoint = contents.electric;
  selection.stokes_single = contents.flow;
  selection.stokes_double = contents.flow && vesicle.viscosity_ratio != 1.0;
  return selection;
}

/// The frozen problem on one membrane at one order.
class FrozenSolver {
 public:
  FrozenSolver(const FrozenState& frozen, const CheckContents& contents, int order)
      : frozen_(frozen),
        space_(space_at(frozen, order)),
        position_(resize_order(membrane_of(frozen).position, order)),
        membrane_(membrane_at(space_, position_, layers_for(contents, vesicle_of(frozen)),
                              vesicle_of(frozen).viscosity_ratio, instruments_)) {
    result.order = order;
    if (contents.electric)
      electric_ = electric_parameters(frozen.model, vesicle_of(frozen)).at(frozen.state.time, Limit::after);
  }

  CheckFields result;

  void solve_prescribed(const Matrix& samples) {
    const Vector potential = resize_order(membrane_of(frozen_).transmembrane_potential, result.order);
    const SecondKindSolution density = charge_density(potential);
    const ElectricTraces traces = electric_traces(electric_, membrane_, potential, density);
    result.charge = membrane_.fine.analyze(traces.charge);
    result.force_electric =
        membrane_.fine.analyze(electric_force(electric_.permittivity, membrane_, traces, electric_.permittivity_ratio));
    const PotentialSources sources{electric_.field, potential, conductivity_contrast(electric_) * density.weighted};
    const PotentialSamples values = potential_at(samples, Side::principal_value, position_, sources, {}, instruments_);
    result.sample_potential = values.potential;
    keep_sides(values.side);
  }

  void solve_steady() {
    const ChargingParameters& charging = vesicle_of(frozen_).charging;
    require_converged(steady_potential(electric_, charging, membrane_, tolerance(), result.steady_potential),
                      "steady membrane potential");
    result.steady_charge = membrane_.fine.analyze(
        electric_traces(electric_, membrane_, result.steady_potential, charge_density(result.steady_potential)).charge);
    if (charging.conductance == 0.0) remove_mean(result.steady_potential);
  }

  void solve_flow(const Matrix& force, const Matrix& samples) {
    const Matrix padded = resize_order(force, result.order);
    const Matrix weighted = membrane_.weighted(membrane_.fine.synthesize(padded));
    const Matrix3 gradient = flow_gradient(frozen_);
    const Matrix driven = position_ * gradient.transpose() + layer(weighted);
    result.velocity = membrane_.velocity(driven);
    if (result.force_electric.size() > 0) {
      const Matrix change =
          resize_order(frozen_.fields.vesicles.front().force_electric, result.order) - result.force_electric;
      result.velocity_own_force =
          membrane_.velocity(driven + layer(membrane_.weighted(membrane_.fine.synthesize(change))));
    }
    // Off the membrane the velocity is known as a single layer alone.
    if (membrane_.contrast) return;
    const auto background = [gradient](const Vector3& x) -> Vector3 { return gradient * x; };
    const VelocitySources sources{frozen_.model.viscosity, background, weighted};
    const VelocitySamples values = velocity_at(samples, position_, sources, {}, instruments_);
    result.sample_velocity = values.velocity;
    keep_sides(values.side);
  }

 private:
  [[nodiscard]] double tolerance() const { return NumericalSettings{}.electric_tolerance; }

  [[nodiscard]] SecondKindSolution charge_density(const Vector& potential) const {
    SecondKindSolution density = solve_second_kind(
        membrane_, conductivity_contrast(electric_),
        weighted_field_flux(membrane_, electric_.field) + weighted_hypersingular(membrane_, potential), tolerance(),
        {});
    require_converged(density.report, "charge density, Eq. (12)");
    return density;
  }

  [[nodiscard]] Matrix layer(const Matrix& weighted) const {
    return membrane_.layers.stokes_single.apply(weighted) / frozen_.model.viscosity;
  }

  void remove_mean(Vector& coefficients) const {
    const double mean = membrane_.weighted(membrane_.fine.synthesize(coefficients))(0, 0) /
                        membrane_.fine.analyze(membrane_.surface.area_element)(0, 0);
    coefficients[0] -= mean * std::sqrt(4.0 * std::numbers::pi);
  }

  void keep_sides(const std::vector<Side>& sides) {
    result.is_inside.clear();
    for (const Side side : sides) result.is_inside.push_back(side == Side::interior);
  }

  const FrozenState& frozen_;
  Instruments instruments_;
  MembraneSpace space_;
  Matrix position_;
  Membrane membrane_;
  ElectricParameters electric_;
};

}  // namespace

CheckContents check_contents(const FrozenState& frozen) {
  const Model& model = frozen.model;
  CheckContents contents;
  contents.flow = model.mobile;
  const double viscosity_ratio = vesicle_of(frozen).viscosity_ratio;
  if (contents.flow && !(viscosity_ratio > 0.0)) {
    throw InputError(fmt::format("{}: the viscosity inside is {:g}; the finite-element check needs it above zero",
                                 frozen.source, viscosity_ratio * model.viscosity));
  }
  if (model.electric) {
    for (const double sigma : {vesicle_of(frozen).inside.conductivity, model.electric->conductivity}) {
      if (sigma > 0.0) continue;
      throw InputError(fmt::format("{}: a conductivity is {:g}; the finite-element check needs both above zero",
                                   frozen.source, sigma));
    }
    contents.steady = !applied_field(frozen).isZero(0.0);
    contents.electric = contents.steady || !membrane_of(frozen).transmembrane_potential.isZero(0.0);
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

Matrix3 flow_gradient(const FrozenState& frozen) {
  if (!frozen.model.flow) return Matrix3::Zero();
  return frozen.model.flow->waveform.at(frozen.state.time, Limit::after) * frozen.model.flow->gradient;
}

Matrix given_force(const FrozenState& frozen) {
  const Matrix& position = membrane_of(frozen).position;
  Matrix force = Matrix::Zero(position.rows(), 3);
  const VesicleFields& fields = frozen.fields.vesicles.front();
  if (fields.force_bending.size() > 0) force += fields.force_bending;
  if (fields.force_tension.size() > 0) force += fields.force_tension;
  if (fields.force_electric.size() > 0) force -= fields.force_electric;
  Model others = frozen.model;
  others.flow.reset();
  const auto effects = explicit_effects(others);
  if (effects.empty()) return force;

  // The run file stores no other forces: they follow from the shape and the time.
  Instruments instruments;
  const Membrane membrane = membrane_at(space_at(frozen, order_of(position.rows())), position, {}, 1.0, instruments);
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
