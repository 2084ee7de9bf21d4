#include "bie/scene/problem.hpp"

#include <numeric>

#include "bie/physics/effects/undulations.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd {

EvolutionSetup setup_of(const Problem& problem) {
  return {problem.model, problem.settings, problem.symmetry, problem.control, problem.frame, problem.names};
}

EventTimes events_of(const Scene& scene) {
  EventTimes events{{scene.output.every, scene.output.times}, scene.numerics.end_time};
  for (const OutputWindow& window : scene.output.windows) {
    events.snapshots.windows.push_back({window.from, window.to, window.every});
  }
  return events;
}

namespace {

Problem problem_from(const Scene& scene, const Model& without_areas, const State* origin) {
  Model model = without_areas;
  State start;
  for (const Scene& one : each_alone(scene)) {
    InitialMembrane membrane = initial_membrane(one);
    VesicleState& vesicle = start.vesicles.emplace_back();
    vesicle.position = std::move(membrane.position);
    vesicle.transmembrane_potential = std::move(membrane.potential);
    vesicle.area_strain = Vector::Zero(vesicle.position.rows());
    if (varies_or_pumps(one)) vesicle.material = initial_material(one);
    std::optional<Undulations>& undulations = model.vesicles[start.vesicles.size() - 1].undulations;
    if (undulations) undulations = with_rest_area(*undulations, size_of(vesicle.position).area);
  }
  if (origin != nullptr) start = *origin;
  Problem problem;
  problem.names = vesicle_names(scene);
  problem.frame = find_frame(model, start);
  problem.model = in_frame(problem.frame, model);
  start = in_frame(problem.frame, std::move(start));
  const Symmetry found = find_symmetry(problem.model, start);
  problem.settings = settings_of(scene);
  problem.settings.beside_wall = model.wall.has_value();
  const bool steady = scene.electric && scene.electric->initial_potential == InitialPotential::steady;
  problem.control = step_control_of(scene);
  problem.settings.longitude_fold = std::lcm(found.fold, found.exchange.fold());
  if (scene.numerics.symmetry != SymmetryUse::off) problem.symmetry = found;
  for (VesicleState& found_at : start.vesicles) {
    problem.start.push_back({std::move(found_at.position),
                             {steady, std::move(found_at.transmembrane_potential)},
                             std::move(found_at.material)});
  }
  return problem;
}

}  // namespace

Problem problem_of(const Scene& scene) { return problem_of(scene, model_of(scene)); }

Problem problem_of(const Scene& scene, const Model& without_areas) {
  return problem_from(scene, without_areas, nullptr);
}

Problem problem_of(const Scene& scene, int start_order, const State* origin) {
  Scene start = scene;
  start.numerics.order = start_order;
  Problem problem = problem_from(start, model_of(start), origin);
  problem.settings.order = scene.numerics.order;
  return problem;
}

}  // namespace vehd
