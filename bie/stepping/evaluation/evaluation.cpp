#include "bie/stepping/evaluation/evaluation.hpp"

#include "bie/stepping/evaluation/diagnose.hpp"
#include "bie/stepping/evaluation/find_rheology.hpp"
#include "bie/stepping/evaluation/poration_load.hpp"

namespace vehd {

Evaluation evaluate(const Model& model, const Discretisation& discretisation, const State& state,
                    Instruments& instruments, const Evaluation* previous, Limit limit) {
  Evaluation evaluation{solve_fields(model, discretisation, state, instruments, previous, limit), {}};
  evaluation.diagnostics.vesicles = discretisation.shares().of_all(state.vesicles.size(), [&](std::size_t a) {
    const VesicleSolution& solution = evaluation.vesicles[a];
    const bool same = previous != nullptr && previous->vesicles[a].membrane == solution.membrane;
    VesicleDiagnostics diagnostics =
        diagnose(diagnosed_model(model, model.vesicles[a]), discretisation.vesicle(a),
                 discretisation.settings().quadrature_tolerance, state.vesicles[a], solution,
                 evaluation.fields.vesicles[a], same ? &previous->diagnostics.vesicles[a] : nullptr);
    diagnostics.rheology = find_rheology(model, model.vesicles[a], state.time, limit, state.vesicles[a], solution,
                                         evaluation.fields.vesicles[a]);
    return diagnostics;
  });
  tell_crossings(state, state.time, evaluation);
  return evaluation;
}

Evaluation without_operators(Evaluation evaluation) {
  for (VesicleSolution& vesicle : evaluation.vesicles) {
    vesicle.membrane.reset();
    vesicle.recycled = {};
    vesicle.force_of_effects = {};
  }
  evaluation.interaction.reset();
  return evaluation;
}

}  // namespace vehd
