#include "bie/physics/membrane_charging.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/deferred_correction.hpp"
#include "bie/stepping/discretisation_tables.hpp"
#include "bie/stepping/membrane_at.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

StepResult step(const Model& model, const Discretisation& discretisation, const State& state,
                const Evaluation& evaluation, double dt, Instruments& instruments) {
  FlowSystems flow = flow_systems(model, discretisation, evaluation);
  const StageContext context{model, discretisation, state, evaluation, flow, instruments};
  StepResult result;
  try {
    const CorrectedStep corrected = deferred_correction(context, dt, discretisation.settings().time_order);
    result.iterations_flow = corrected.stage.iterations_flow;
    result.iterations_electric = corrected.stage.iterations_electric;
    result.accepted = corrected.stage.accepted;
    result.reason = corrected.stage.reason;
    result.change = corrected.change;
    result.raw_area = corrected.stage.move.raw_area;
    if (result.accepted) result.state = arrived_state(context, corrected.stage);
  } catch (const ConvergenceError& error) {
    result.reason = error.what();
  }
  return result;
}

State initial_state(const Model& model, const Discretisation& discretisation, const Matrix& position,
                    const StartPotential& potential, double dt, Instruments& instruments) {
  const Discretisation::Tables& tables = discretisation.tables();
  State state;
  state.dt_next = dt;
  state.position = position;
  state.area_strain = Vector::Zero(position.rows());
  if (model.electric) {
    state.transmembrane_potential = Vector::Zero(position.rows());
    if (potential.given.size() > 0) {
      state.transmembrane_potential = resize_order(potential.given, order_of(position.rows()));
    }
  }
  state = symmetric_part(tables.symmetry, std::move(state));
  const Surface surface = make_surface(tables.fine, position);
  state.reference_area = surface_area(surface);
  state.reference_volume = enclosed_volume(surface);
  if (model.inextensible) state.tension = Vector::Zero(position.rows());
  if (model.electric && potential.steady) {
    const Membrane membrane = membrane_at(discretisation, position, {true, true, true, false}, 1.0, instruments);
    require_converged(steady_potential(*model.electric, *model.charging, membrane, tables.settings.electric_tolerance,
                                       state.transmembrane_potential),
                      "steady membrane potential");
  }
  return state;
}

}  // namespace vehd
