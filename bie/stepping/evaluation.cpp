#include "bie/physics/bending.hpp"
#include "bie/physics/electric.hpp"
#include "bie/physics/tension.hpp"
#include "bie/stepping/composition.hpp"
#include "bie/stepping/diagnostics.hpp"
#include "bie/stepping/discretisation_tables.hpp"
#include "bie/stepping/evaluation_parts.hpp"
#include "bie/stepping/flow_solve.hpp"
#include "bie/stepping/health.hpp"
#include "bie/stepping/membrane_at.hpp"
#include "bie/stepping/wrinkling.hpp"

namespace vehd {

namespace {

Membrane assembled(const Discretisation& discretisation, const Matrix& position, const LayerSelection& selection,
                   double viscosity_ratio, Instruments& instruments) {
  const auto timer = instruments.time("operator assembly");
  return membrane_at(discretisation, position, selection, viscosity_ratio, instruments);
}

/// dV_m/dt = −(σ_i ∂φ_i/∂n + G_m V_m)/C_m, Eq. (4e). No net current leaves a closed membrane, which the quadrature
/// sees only up to its error.
Vector charging_rate(const ElectricParameters& electric, const ChargingParameters& charging, const Membrane& membrane,
                     const Vector& potential, const ElectricTraces& traces) {
  const Vector& area = membrane.surface.quadrature;
  Vector current = electric.conductivity_in * traces.flux_in;
  current.array() -= current.dot(area) / area.sum();
  return -(membrane.fine.analyze(current) + charging.conductance * potential) / charging.capacitance;
}

/// f_E with q and dV_m/dt as by-products, Eqs. (12), (15), (32).
Matrix solve_electric(const ElectricParameters& electric, const ChargingParameters& charging, const Membrane& membrane,
                      const Vector& potential, double tolerance, Evaluation& evaluation) {
  const Vector rhs = weighted_field_flux(membrane, electric.field) + weighted_hypersingular(membrane, potential);
  const SecondKindSolution density = solve_second_kind(membrane, conductivity_contrast(electric), rhs, tolerance, {});
  require_converged(density.report, "charge density, Eq. (12)");
  evaluation.iterations_electric = density.report.iterations;
  const ElectricTraces traces = electric_traces(electric, membrane, potential, density);
  evaluation.fields.charge = membrane.fine.analyze(traces.charge);
  evaluation.potential_rate = charging_rate(electric, charging, membrane, potential, traces);
  return electric_force(electric.permittivity, membrane, traces, electric.permittivity_ratio);
}

/// Velocity of the membrane under the forcing, with the tension that keeps it inextensible, Eq. (27b).
Matrix solve_velocity(const Model& model, const Discretisation& discretisation, const Membrane& membrane,
                      const Forcing& forcing, const State& state, Evaluation& evaluation, bool& is_sphere) {
  Matrix velocity = forcing.velocity;
  if (!membrane.layers.stokes_single.empty()) {
    velocity += membrane.layers.stokes_single.apply(membrane.weighted(forcing.force)) / model.viscosity;
  }
  velocity = membrane.velocity(std::move(velocity));
  if (!model.inextensible) return velocity;
  const VelocityField driven = velocity_field(membrane, velocity, false);
  const FlowRightHandSide rhs{{}, -weighted_divergence(membrane, driven.derivatives)};
  is_sphere = uniform_tension_is_free(model, membrane);
  const FlowOptions options{is_sphere, {}, discretisation.tables().even_scalars};
  const std::shared_ptr<const ScalarResponses> known = state.flow_memory.tension;
  FlowSystem system(model, membrane, 0.0, options, known ? known->in(options.entries, 1) : KnownResponses{});
  const FlowSystem::Solution solution =
      system.solve(rhs, {{}, state.tension}, discretisation.settings().flow_tolerance);
  require_converged(solution.report, "tension, Eq. (27b)");
  evaluation.flow_memory.tension =
      remembered(options.entries, joined(system.learned(), system.kept(), most_known_responses));
  evaluation.iterations_flow = solution.report.iterations;
  velocity += solution.velocity;
  evaluation.fields.tension = solution.unknowns.tension;
  evaluation.fields.force_tension = membrane.fine.analyze(tension_force(membrane, solution.unknowns.tension));
  return velocity;
}

}  // namespace

namespace {

void watch(const Discretisation& discretisation, const State& state, const Membrane& membrane, Evaluation& evaluation) {
  // Truncation hides what is this close above it.
  constexpr double kAboveTruncation = 3.0;
  const LayerCheck check = check_layers(membrane);
  evaluation.diagnostics.quadrature_error = check.error;
  evaluation.quadrature_is_coarse =
      check.error > discretisation.settings().quadrature_tolerance && check.error > kAboveTruncation * check.truncation;
  evaluation.diagnostics.separation =
      separation(discretisation.transform(), state.position, discretisation.symmetry().axisymmetric);
}

}  // namespace

Evaluation evaluate(const Model& model, const Discretisation& discretisation, const State& state,
                    Instruments& instruments, const Evaluation* previous, Limit limit) {
  const NumericalSettings& settings = discretisation.settings();
  const bool asleep =
      model.electric && (limit == Limit::after ? electric_sleeps(model, state) : electric_is_silent(model, state));
  const bool reuse = !model.mobile && previous != nullptr && (asleep || !previous->electric_asleep);
  Evaluation evaluation;
  evaluation.electric_asleep = asleep;
  evaluation.flow_memory = state.flow_memory;
  std::shared_ptr<Evaluation::Parts> made;
  if (!reuse) {
    made = std::make_shared<Evaluation::Parts>(Evaluation::Parts{
        assembled(discretisation, state.position, needed_layers(model, !asleep), model.viscosity_ratio, instruments),
        {},
        false});
  }
  const Membrane& membrane = reuse ? previous->parts->membrane : made->membrane;
  Fields& fields = evaluation.fields;

  Forcing forcing{Matrix::Zero(membrane.surface.n_points(), 3), Matrix::Zero(state.position.rows(), 3)};
  if (model.electric && asleep) {
    fields.charge = Vector::Zero(state.position.rows());
    evaluation.potential_rate = Vector::Zero(state.position.rows());
    fields.force_electric = Matrix::Zero(state.position.rows(), 3);
  } else if (model.electric) {
    const auto timer = instruments.time("electric");
    const Matrix electric = solve_electric(model.electric->at(state.time, limit), *model.charging, membrane,
                                           state.transmembrane_potential, settings.electric_tolerance, evaluation);
    fields.force_electric = membrane.fine.analyze(electric);
    forcing.force -= electric;
  }
  if (model.mobile) {
    const auto timer = instruments.time("tension solve");
    for (const auto& effect : explicit_effects(model)) {
      effect->add({membrane, state.position, state.time, limit}, forcing);
    }
    if (model.bending) {
      const Matrix bending = bending_force(*model.bending, membrane);
      fields.force_bending = membrane.fine.analyze(bending);
      forcing.force += bending;
    }
    fields.velocity = solve_velocity(model, discretisation, membrane, forcing, state, evaluation, made->is_sphere);
    made->velocity = fields.velocity;
  }
  evaluation.diagnostics = diagnose(state, membrane, fields);
  // The tension of a sphere is known up to its mean.
  if (fields.tension.size() > 0 && !made->is_sphere) {
    evaluation.diagnostics.wrinkle_degree =
        wrinkle_degree(model, membrane.fine.synthesize(fields.tension).minCoeff(), membrane.radius);
  }
  if (reuse) {
    evaluation.diagnostics.quadrature_error = previous->diagnostics.quadrature_error;
    evaluation.diagnostics.separation = previous->diagnostics.separation;
    evaluation.quadrature_is_coarse = previous->quadrature_is_coarse;
  } else {
    watch(discretisation, state, membrane, evaluation);
  }
  evaluation.parts = reuse ? previous->parts : std::move(made);
  return evaluation;
}

}  // namespace vehd
