#include <cmath>
#include <numbers>

#include "bie/physics/bending.hpp"
#include "bie/physics/tension.hpp"
#include "bie/stepping/diagnostics.hpp"
#include "bie/stepping/discretisation_tables.hpp"
#include "bie/stepping/evaluation_parts.hpp"
#include "bie/stepping/flow_solve.hpp"

namespace vehd {

namespace {

Membrane make_membrane(const Model& model, const Discretisation& discretisation, const Matrix& position,
                       Instruments& instruments) {
  const Discretisation::Tables& tables = discretisation.tables();
  Surface surface = make_surface(tables.fine, position);
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  LayerSelection selection;
  selection.stokes_single = true;
  selection.laplace_single = selection.laplace_double = selection.laplace_adjoint = model.electric.has_value();
  const auto timer = instruments.time("operator assembly");
  LayerOperators layers = assemble_layer_operators(tables.quadrature, tables.targets, position, selection, instruments,
                                                   tables.symmetry.reflections);
  return {tables.fine, std::move(surface), std::move(layers), radius};
}

}  // namespace

Evaluation evaluate(const Model& model, const Discretisation& discretisation, const State& state,
                    Instruments& instruments) {
  const NumericalSettings& settings = discretisation.settings();
  Evaluation evaluation;
  auto parts = std::make_shared<Evaluation::Parts>(
      Evaluation::Parts{make_membrane(model, discretisation, state.position, instruments), {}, false});
  const Membrane& membrane = parts->membrane;
  Fields& fields = evaluation.fields;

  Matrix force = Matrix::Zero(membrane.surface.n_points(), 3);
  if (model.bending) {
    const Matrix bending = bending_force(*model.bending, membrane);
    fields.force_bending = membrane.fine.analyze(bending);
    force += bending;
  }
  if (model.electric) {
    const auto timer = instruments.time("electric");
    const Vector rhs = weighted_field_flux(membrane, model.electric->field) +
                       weighted_hypersingular(membrane, state.transmembrane_potential);
    const SecondKindSolution density =
        solve_second_kind(membrane, conductivity_contrast(*model.electric), rhs, settings.electric_tolerance, {});
    require_converged(density.report, "charge density, Eq. (12)");
    evaluation.iterations_electric = density.report.iterations;
    const ElectricTraces traces = electric_traces(*model.electric, membrane, state.transmembrane_potential, density);
    const Matrix electric = electric_force(model.electric->permittivity, membrane, traces);
    fields.force_electric = membrane.fine.analyze(electric);
    fields.charge = membrane.fine.analyze(traces.charge);
    force -= electric;
  }

  {
    const auto timer = instruments.time("tension solve");
    Matrix velocity = membrane.layers.stokes_single.apply(membrane.weighted(force)) / model.viscosity;
    if (model.flow) velocity += state.position * model.flow->gradient.transpose();
    if (model.inextensible) {
      const VelocityField driven = velocity_field(membrane, velocity, false);
      MembraneUnknowns unknowns;
      unknowns.tension = state.tension;
      const FlowRightHandSide rhs{{}, -weighted_divergence(membrane, driven.derivatives)};
      parts->is_sphere = uniform_tension_is_free(model, membrane);
      const FlowOptions options{settings.flow_tolerance, parts->is_sphere};
      const SolveReport report = solve_flow(model, membrane, 0.0, rhs, options, unknowns);
      require_converged(report, "tension, Eq. (27b)");
      evaluation.iterations_flow = report.iterations;
      velocity += membrane_velocity(model, membrane, unknowns);
      fields.tension = unknowns.tension;
      fields.force_tension = membrane.fine.analyze(tension_force(membrane, unknowns.tension));
    }
    parts->velocity = velocity;
    fields.velocity = std::move(velocity);
  }
  evaluation.diagnostics = diagnose(state, membrane, fields);
  evaluation.parts = std::move(parts);
  return evaluation;
}

}  // namespace vehd
