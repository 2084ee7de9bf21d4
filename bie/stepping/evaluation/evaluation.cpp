#include "bie/stepping/evaluation/evaluation.hpp"

#include "bie/stepping/evaluation/diagnose.hpp"
#include "bie/stepping/evaluation/find_rheology.hpp"
#include "bie/stepping/evaluation/poration_load.hpp"

namespace vehd {

Evaluation evaluate(const Model& model, const Discretisation& discretisation, const State& state,
                    Instruments& instruments, const Evaluation* previous, Limit limit) {
  Evaluation evaluation{solve_fields(model, discretisation, state, instruments, previous, limit), {}};
  const auto diagnosed = [&](std::size_t a, const VesicleDiagnostics* with_same_operators) {
    const VesicleSolution& solution = evaluation.vesicles[a];
    VesicleDiagnostics diagnostics = diagnose(diagnosed_model(model, model.vesicles[a]), discretisation.vesicle(a),
                                              discretisation.settings().quadrature_tolerance, state.vesicles[a],
                                              solution, evaluation.fields.vesicles[a], with_same_operators);
    diagnostics.rheology = find_rheology(model, model.vesicles[a], state.time, limit, state.vesicles[a], solution,
                                         evaluation.fields.vesicles[a]);
    return diagnostics;
  };
  evaluation.diagnostics.vesicles = discretisation.shares().of_all(
      state.vesicles.size(),
      [&](std::size_t a) {
        const bool same = previous != nullptr && previous->vesicles[a].membrane == evaluation.vesicles[a].membrane;
        return diagnosed(a, same ? &previous->diagnostics.vesicles[a] : nullptr);
      },
      // An image has no operators of its own.
      [&](const VesicleDiagnostics& of_original, std::size_t a) { return diagnosed(a, &of_original); });
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
