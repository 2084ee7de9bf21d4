#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/physics/membrane_charging.hpp"
#include "bie/stepping/constrained_move.hpp"
#include "bie/stepping/discretisation_tables.hpp"
#include "bie/stepping/reparametrisation.hpp"
#include "bie/stepping/rigid_sphere.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// V_m after the step, Eq. (30). @returns false where the solve fails
bool charge(const Model& model, const Discretisation::Tables& tables, const Membrane& membrane, double time, double dt,
            Vector& potential, int& iterations) {
  const double end = time + dt;
  const SolveReport report = charge_membrane(model.electric->at(end, Limit::before), *model.charging, membrane, dt,
                                             tables.settings.electric_tolerance, potential);
  iterations = report.iterations;
  // A potential this small does nothing any more, and without it the electric part can sleep.
  constexpr double kDecayed = 1e-10;
  const double scale = model.electric->field.norm() * membrane.radius;
  if (model.electric->waveform.is_quiet(end) && potential.norm() < kDecayed * scale) potential.setZero();
  return report.converged;
}

}  // namespace

StepResult step(const Model& model, const Discretisation& discretisation, const State& state,
                const Evaluation& evaluation, double dt, Instruments& instruments) {
  const Discretisation::Tables& tables = discretisation.tables();
  const Evaluation::Parts& parts = *evaluation.parts;
  StepResult result;
  State& next = result.state;
  next = state;
  next.time = state.time + dt;
  next.step = state.step + 1;
  if (model.electric && !evaluation.electric_asleep) {
    const auto timer = instruments.time("electric");
    if (!charge(model, tables, parts.membrane, state.time, dt, next.transmembrane_potential,
                result.iterations_electric)) {
      result.reason = "membrane charging, Eq. (30), did not converge";
      return result;
    }
  }
  if (!model.mobile) {
    next = symmetric_part(tables.symmetry, std::move(next));
    result.accepted = next.transmembrane_potential.allFinite();
    if (!result.accepted) result.reason = "the new state is not finite";
    return result;
  }

  // Columns: x, strain, then whatever the model carries.
  const Landing landing = [&](const ConstrainedMove& move) {
    const auto timer = instruments.time("reparametrisation");
    Matrix fields(move.position.rows(), 4 + (model.electric ? 1 : 0) + (model.inextensible ? 1 : 0));
    fields.leftCols(3) = move.position;
    fields.col(3) = move.area_strain;
    Index column = 4;
    if (model.electric) fields.col(column++) = next.transmembrane_potential;
    if (model.inextensible) fields.col(column++) = move.tension;
    return reparametrise(tables.fine, make_surface(tables.fine, move.position), move.position, dt * move.velocity,
                         fields);
  };
  const auto timer = instruments.time("velocity solve");
  const Vector& tension = evaluation.fields.tension;
  const ConstrainedMove move = parts.is_sphere
                                   ? rigid_sphere_move(state, parts, tension, dt, landing)
                                   : constrained_move(model, discretisation, state, parts, tension, dt, landing);
  result.iterations_flow = move.iterations;
  if (!move.accepted) {
    result.reason = move.reason;
    return result;
  }
  const Matrix& fields = move.landed;
  if (!fields.allFinite()) {
    result.reason = "the new state is not finite";
    return result;
  }
  next.position = fields.leftCols(3);
  next.area_strain = fields.col(3);
  Index column = 4;
  if (model.electric) next.transmembrane_potential = fields.col(column++);
  if (model.inextensible) next.tension = fields.col(column++);
  next = symmetric_part(tables.symmetry, std::move(next));
  result.accepted = true;
  return result;
}

Advance advance(const Model& model, const Discretisation& discretisation, const State& state,
                const Evaluation& evaluation, double dt_nominal, double dt_limit, Instruments& instruments) {
  constexpr double kSmallestFraction = 1.0 / 1024.0;
  constexpr double kRounding = 1e-9;
  Advance result;
  double wanted = std::min(state.dt_next, dt_nominal);
  while (wanted >= kSmallestFraction * dt_nominal) {
    // A limit that is the wanted step up to rounding is taken exactly: the caller has an appointment there.
    const double dt = dt_limit <= wanted * (1.0 + kRounding) ? dt_limit : wanted;
    const StepResult attempt = step(model, discretisation, state, evaluation, dt, instruments);
    result.iterations_flow += attempt.iterations_flow;
    result.iterations_electric += attempt.iterations_electric;
    if (attempt.accepted) {
      result.accepted = true;
      result.state = attempt.state;
      result.dt = dt;
      result.state.dt_next = std::min(dt_nominal, result.rejected == 0 ? 2.0 * wanted : wanted);
      return result;
    }
    result.reason = attempt.reason;
    ++result.rejected;
    wanted = 0.5 * dt;
  }
  return result;
}

State initial_state(const Model& model, const Discretisation& discretisation, const Matrix& position, bool steady_start,
                    double dt, Instruments& instruments) {
  const Discretisation::Tables& tables = discretisation.tables();
  State state;
  state.dt_next = dt;
  state.position = position;
  state.area_strain = Vector::Zero(position.rows());
  state = symmetric_part(tables.symmetry, std::move(state));
  Surface surface = make_surface(tables.fine, position);
  state.reference_area = surface_area(surface);
  state.reference_volume = enclosed_volume(surface);
  if (model.inextensible) state.tension = Vector::Zero(position.rows());
  if (!model.electric) return state;
  state.transmembrane_potential = Vector::Zero(position.rows());
  if (steady_start) {
    const double radius = std::sqrt(state.reference_area / (4.0 * std::numbers::pi));
    const LayerSelection selection{true, true, true, false};
    const Membrane membrane{tables.fine, std::move(surface),
                            assemble_layer_operators(tables.quadrature, tables.targets, position, selection,
                                                     instruments, tables.symmetry.reflections, tables.symmetry.fold),
                            radius};
    require_converged(steady_potential(*model.electric, *model.charging, membrane, tables.settings.electric_tolerance,
                                       state.transmembrane_potential),
                      "steady membrane potential");
  }
  return state;
}

}  // namespace vehd
