#include <numeric>

#include "bie/stepping/space/remap.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/time/step_operations.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

void require_finite(const Motion& motion) {
  bool finite = motion.arrived.position.allFinite();
  for_each_scalar(motion.arrived, [&](const Vector& scalar) { finite = finite && scalar.allFinite(); });
  if (!finite) throw ConvergenceError("the new state is not finite");
}

}  // namespace

std::vector<Motion> StepOperations::motions(const std::vector<MotionStart>& starts, const RigidMotion& rigid, double dt,
                                            NodeEnd end) {
  std::vector<Motion> result(starts.size());
  std::vector<int> iterations(starts.size(), 0);
  const auto move = [&](Index i, Instruments& instruments) {
    const auto a = static_cast<std::size_t>(i);
    result[a] = motion(a, starts[a], rigid, dt, end, instruments, iterations[a]);
    require_finite(result[a]);
  };
  // Those of solves that fail count all the same.
  const auto count = [&] { iterations_flow_ += std::accumulate(iterations.begin(), iterations.end(), 0); };
  try {
    for_each_member(static_cast<Index>(starts.size()), instruments_, move);
  } catch (...) {
    count();
    throw;
  }
  count();
  return result;
}

Motion StepOperations::motion(std::size_t a, const MotionStart& start, const RigidMotion& rigid, double dt, NodeEnd end,
                              Instruments& instruments, int& iterations) {
  const VesicleSolution& solution = at_start_.vesicles[a];
  if (!model_.mobile) {
    Motion resting;
    resting.material = resting.arrived = start.fields;
    return resting;
  }
  const auto timer = instruments.time("velocity solve");
  const Arrival there = arrival(a, end, instruments);
  if (solution.is_sphere) {
    return rigid_sphere_motion(start.fields, *solution.membrane, rigid(a, *solution.membrane), there);
  }
  const FlowParameters parameters = flow_parameters(model_, model_.vesicles[a]);
  return constrained_motion({parameters, discretisation_.settings(), start_.vesicles[a], *solution.membrane}, start, dt,
                            flow_[a].of(dt), there, iterations);
}

Arrival StepOperations::arrival(std::size_t a, NodeEnd end, Instruments& instruments) const {
  if (end == NodeEnd::material) return [](const SurfaceFields& material) { return material; };
  return [this, a, &instruments](const SurfaceFields& material) {
    const auto timer = instruments.time("remap");
    return remap(discretisation_.vesicle(a).fine_transform(), material.position - start_.vesicles[a].position,
                 material);
  };
}

}  // namespace vehd
