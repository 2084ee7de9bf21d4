#include "bie/stepping/stage.hpp"

#include "bie/physics/membrane_charging.hpp"
#include "bie/stepping/discretisation_tables.hpp"
#include "bie/stepping/reparametrisation.hpp"
#include "bie/stepping/rigid_sphere.hpp"

namespace vehd {

namespace {

/// Columns: x, strain, then whatever the model carries.
Matrix packed(const Model& model, const ConstrainedMove& move, const Vector& potential) {
  Matrix fields(move.position.rows(), 4 + (model.electric ? 1 : 0) + (model.inextensible ? 1 : 0));
  fields.leftCols(3) = move.position;
  fields.col(3) = move.area_strain;
  Index column = 4;
  if (model.electric) fields.col(column++) = potential;
  if (model.inextensible) fields.col(column++) = move.tension;
  return fields;
}

State unpacked(const StageContext& context, const Matrix& fields, double time) {
  State state = context.state;
  state.time = time;
  state.position = fields.leftCols(3);
  state.area_strain = fields.col(3);
  Index column = 4;
  if (context.model.electric) state.transmembrane_potential = fields.col(column++);
  if (context.model.inextensible) state.tension = fields.col(column++);
  return symmetric_part(context.discretisation.symmetry(), std::move(state));
}

Landing landing_of(const StageContext& context, const Vector& potential, StageEnd end) {
  return [&context, &potential, end](const ConstrainedMove& move) -> Matrix {
    const Matrix fields = packed(context.model, move, potential);
    if (end == StageEnd::material) return fields;
    const auto timer = context.instruments.time("reparametrisation");
    const SphereTransform& fine = context.discretisation.fine_transform();
    return reparametrise(fine, make_surface(fine, move.position), move.position - context.state.position, fields);
  };
}

void require_finite(Stage& stage) {
  if (!stage.accepted || (stage.potential.allFinite() && stage.move.landed.allFinite())) return;
  stage.accepted = false;
  stage.reason = "the new state is not finite";
}

/// Membrane at its place: a frozen shape.
ConstrainedMove no_move(const StageContext& context, const Vector& potential) {
  ConstrainedMove move;
  move.accepted = true;
  move.position = context.state.position;
  move.area_strain = context.state.area_strain;
  move.tension = context.state.tension;
  move.landed = packed(context.model, move, potential);
  return move;
}

void keep(Stage& stage, ConstrainedMove move) {
  stage.iterations_flow = move.iterations;
  stage.accepted = move.accepted;
  if (!move.accepted) stage.reason = move.reason;
  stage.move = std::move(move);
  require_finite(stage);
}

bool charges(const StageContext& context) {
  return context.model.electric.has_value() && !context.evaluation.electric_asleep;
}

/// Eq. (30) from `potential`. @returns false where the solve fails
bool charge(const StageContext& context, const ElectricParameters& electric, double dt, Vector& potential,
            Stage& stage) {
  const auto timer = context.instruments.time("electric");
  const SolveReport report = charge_membrane(electric, *context.model.charging, context.evaluation.parts->membrane, dt,
                                             context.discretisation.settings().electric_tolerance, potential);
  stage.iterations_electric = report.iterations;
  if (!report.converged) stage.reason = "membrane charging, Eq. (30), did not converge";
  return report.converged;
}

/// The paper's scheme leaves explicit what a change of H does to the tension that is there. An ellipsoidal disturbance
/// of a sphere relaxes under a tension λ at the rate 24 λ/((32 + 23 μ_i/μ_e) μ_e R) (quasi-spherical theory), and an
/// explicit step overshoots where it relaxes by more than all of it, as near the sphere, where tensions are large. The
/// first-order step leaves explicit the tension that relaxes by this much, and holds the rest.
constexpr double kExplicitRelaxation = 0.5;

/// A potential this small does nothing any more, and without it the electric part can sleep.
void forget_decayed(const StageContext& context, Stage& stage) {
  constexpr double kDecayed = 1e-10;
  const ElectricParameters& electric = *context.model.electric;
  const double scale = electric.field.norm() * context.evaluation.parts->membrane.radius;
  if (electric.waveform.is_quiet(stage.time) && stage.potential.norm() < kDecayed * scale) stage.potential.setZero();
}

}  // namespace

FlowSystems::FlowSystems(const Model& model, const Membrane& membrane, FlowOptions options, double explicit_relaxation,
                         std::shared_ptr<const ScalarResponses> known)
    : model_(model),
      membrane_(membrane),
      options_(std::move(options)),
      explicit_tension_time_(explicit_relaxation * (32.0 + 23.0 * model.viscosity_ratio) / 24.0 * model.viscosity *
                             membrane.radius),
      known_(std::move(known)) {}

FlowSystem& FlowSystems::of(double dt) {
  for (auto& [size, system] : systems_) {
    if (size == dt) return system;
  }
  const std::shared_ptr<const ScalarResponses> so_far = known();
  const Index n_scalars = (model_.bending ? 1 : 0) + (model_.inextensible ? 1 : 0);
  FlowOptions options = options_;
  options.held_tension = (options_.held_tension.array() - explicit_tension_time_ / dt).cwiseMax(0.0);
  if (options.held_tension.isZero(0.0)) options.held_tension.resize(0);
  FlowSystem system(model_, membrane_, dt, options,
                    so_far ? so_far->in(options_.entries, n_scalars) : KnownResponses{});
  return systems_.emplace_back(dt, std::move(system)).second;
}

std::shared_ptr<const ScalarResponses> FlowSystems::known() const {
  if (systems_.empty()) return known_;
  KnownResponses all = systems_.front().second.kept();
  for (const auto& [size, system] : systems_) all = joined(system.learned(), all, most_known_responses);
  return remembered(options_.entries, std::move(all));
}

FlowSystems flow_systems(const Model& model, const Discretisation& discretisation, const Evaluation& evaluation) {
  const Membrane& membrane = evaluation.parts->membrane;
  FlowOptions options;
  options.entries = discretisation.tables().even_scalars;
  if (model.inextensible && model.mobile) {
    // A compression would soften the implicit response.
    options.held_tension = membrane.fine.synthesize(evaluation.fields.tension).col(0).cwiseMax(0.0);
  }
  const double explicit_relaxation = discretisation.settings().time_order == 1 ? kExplicitRelaxation : 0.0;
  return {model, membrane, options, explicit_relaxation, evaluation.flow_memory.flow};
}

Stage first_order_stage(const StageContext& context, double dt, StageEnd end) {
  Stage stage;
  stage.time = context.state.time + dt;
  stage.potential = context.state.transmembrane_potential;
  if (charges(context)) {
    if (!charge(context, context.model.electric->at(stage.time, Limit::before), dt, stage.potential, stage)) {
      return stage;
    }
    forget_decayed(context, stage);
  }
  if (!context.model.mobile) {
    keep(stage, no_move(context, stage.potential));
    return stage;
  }
  const auto timer = context.instruments.time("velocity solve");
  const Evaluation::Parts& parts = *context.evaluation.parts;
  const Vector& tension = context.evaluation.fields.tension;
  const Landing landing = landing_of(context, stage.potential, end);
  keep(stage,
       parts.is_sphere
           ? rigid_sphere_move(context.state, parts.membrane, motion_of_velocity(parts.membrane, parts.velocity, dt),
                               tension, landing)
           : constrained_move(context.model, context.discretisation, context.state, parts,
                              {context.state.position, parts.velocity, tension}, dt, context.flow.of(dt), landing));
  return stage;
}

Stage corrected_stage(const StageContext& context, const Stage& stage, const StageResidual& residual, double dt,
                      StageEnd end) {
  Stage result;
  result.time = stage.time;
  result.potential = stage.potential;
  if (charges(context)) {
    ElectricParameters homogeneous = context.model.electric->at(stage.time, Limit::before);
    homogeneous.field.setZero();
    Vector change = residual.potential;
    if (!charge(context, homogeneous, dt, change, result)) return result;
    result.potential += change;
    forget_decayed(context, result);
  }
  if (!context.model.mobile) {
    keep(result, no_move(context, result.potential));
    return result;
  }
  const auto timer = context.instruments.time("velocity solve");
  const Evaluation::Parts& parts = *context.evaluation.parts;
  const Landing landing = landing_of(context, result.potential, end);
  if (parts.is_sphere) {
    // A rigid motion has no stiffness, so nothing of it is implicit.
    const Matrix displacement = stage.move.position + residual.position - context.state.position;
    keep(result, rigid_sphere_move(context.state, parts.membrane, motion_of_displacement(parts.membrane, displacement),
                                   stage.move.tension, landing));
  } else {
    keep(result, constrained_move(context.model, context.discretisation, context.state, parts,
                                  {stage.move.position, residual.position / dt, stage.move.tension}, dt,
                                  context.flow.of(dt), landing));
  }
  return result;
}

State arrived_state(const StageContext& context, const Stage& stage) {
  State state = unpacked(context, stage.move.landed, stage.time);
  state.flow_memory = memory_after_step(context.evaluation.flow_memory, context.flow.known(), stage.iterations_flow);
  state.step = context.state.step + 1;
  return state;
}

State stage_state(const StageContext& context, const Stage& stage) {
  State state = unpacked(context, packed(context.model, stage.move, stage.potential), stage.time);
  state.flow_memory = context.evaluation.flow_memory;
  return state;
}

}  // namespace vehd
