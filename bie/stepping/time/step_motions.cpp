#include <string>
#include <utility>

#include "bie/stepping/space/remap.hpp"
#include "bie/stepping/state/exchange.hpp"
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

/// A motion with the iterations that it took, or why there is none.
struct CountedMotion {
  Motion motion;
  int iterations = 0;
  std::string failure{};
};

template <MaybeConst<CountedMotion> Sent, typename Visit>
void visit_members(Sent& sent, Visit& visit) {
  visit(sent.motion, sent.iterations, sent.failure);
}

}  // namespace

std::vector<Motion> StepOperations::motions(const std::vector<MotionStart>& starts, const RigidMotion& rigid, double dt,
                                            NodeEnd end, NodeWork& work) {
  std::vector<CountedMotion> all(starts.size());
  const auto move = [&](std::size_t a, Instruments& instruments) {
    CountedMotion& of_one = all[a];
    try {
      of_one.motion = motion(a, starts[a], rigid, dt, end, instruments, of_one.iterations);
      require_finite(of_one.motion);
    } catch (const ConvergenceError& error) {
      of_one.failure = error.what();
      throw;
    }
  };
  shares().ranks().together([&] {
    try {
      for_each_member(shares().own(all.size()), work.instruments, move);
    } catch (const ConvergenceError&) {
      // Which vesicle is the first without a motion all ranks have to say.
    }
    shares().gather(all, [this](const CountedMotion& of_original, std::size_t a) -> CountedMotion {
      const ImageOfFields& image = discretisation_.symmetry().exchange.image(a);
      Motion motion = of_original.motion;
      for (SurfaceFields* fields : {&motion.material, &motion.arrived}) *fields = image_of(image, *fields);
      return {std::move(motion)};
    });
  });
  std::vector<Motion> result;
  for (CountedMotion& of_one : all) {
    // Those of solves that fail count all the same.
    work.iterations.flow += of_one.iterations;
    if (!of_one.failure.empty()) throw ConvergenceError(of_one.failure);
    result.push_back(std::move(of_one.motion));
  }
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
  if (solution.is_sphere) {
    const Membrane& sphere = *solution.membrane;
    const SphereMotion moved = rigid(a, sphere);
    Motion result;
    result.material = moved_sphere(start.fields, sphere, moved);
    result.arrived = end == NodeEnd::material
                         ? result.material
                         : at_translated_nodes(start_.vesicles[a].position, sphere, moved, result.material);
    return result;
  }
  const FlowParameters parameters = flow_parameters(model_, model_.vesicles[a]);
  return constrained_motion({parameters, discretisation_.settings(), start_.vesicles[a], *solution.membrane}, start, dt,
                            flow_[a].of(dt), arrival(a, end, instruments), iterations);
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
