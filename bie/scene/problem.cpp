#include "bie/scene/problem.hpp"

#include "bie/scene/initial_shape.hpp"
#include "bie/scene/model_of.hpp"

namespace vehd {

EvolutionSetup setup_of(const Problem& problem) {
  return {problem.model, problem.settings, problem.symmetry, problem.control};
}

Problem problem_of(const Scene& scene) { return problem_of(scene, model_of(scene)); }

Problem problem_of(const Scene& scene, int start_order) {
  Scene start = scene;
  start.numerics.order = start_order;
  Problem problem = problem_of(start);
  problem.settings.order = scene.numerics.order;
  return problem;
}

Problem problem_of(const Scene& scene, const Model& model) {
  State start;
  InitialMembrane membrane = initial_membrane(scene);
  start.position = std::move(membrane.position);
  start.transmembrane_potential = std::move(membrane.potential);
  start.area_strain = Vector::Zero(start.position.rows());
  Problem problem;
  problem.frame = find_frame(model, start);
  problem.model = in_frame(problem.frame, model);
  start = in_frame(problem.frame, std::move(start));
  const Symmetry found = find_symmetry(problem.model, start);
  problem.settings = settings_of(scene);
  problem.potential.steady = scene.electric && scene.electric->initial_potential == InitialPotential::steady;
  problem.control = step_control_of(scene);
  problem.settings.longitude_fold = found.fold;
  if (scene.numerics.symmetry != SymmetryUse::off) problem.symmetry = found;
  problem.position = std::move(start.position);
  problem.potential.given = std::move(start.transmembrane_potential);
  return problem;
}

}  // namespace vehd
