#include "bie/stepping/time/step_operations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "bie/physics/averaged_field.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/stepping/space/remap.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"
#include "bie/support/side_by_side.hpp"

namespace vehd {

namespace {

/// A disturbance that relaxes completely within one explicit step overshoots. The first-order step treats explicitly
/// the tension under which a disturbance of a sphere relaxes by this share, and the rest implicitly.
constexpr double relaxation_left_explicit = 0.5;
/// A potential without a field below this share of |E|R has decayed: its stress, quadratic in it, is below rounding.
constexpr double decayed_potential = 1e-10;

/// Compression −λ that a sphere no longer resists in its softest disturbance, an ellipsoidal one: 3κ_B/R²
/// (quasi-spherical theory).
double buckling_compression(const FlowParameters& parameters, double radius) {
  return parameters.bending ? 3.0 * parameters.bending->modulus / (radius * radius) : 0.0;
}

FlowOptions flow_options(const FlowParameters& parameters, bool mobile, const MembraneSpace& space, int time_order,
                         const Membrane& membrane, const Vector& tension) {
  FlowOptions options;
  options.curvature_transform = space.curvature_transform();
  options.entries = space.curvature_subspace().scalars();
  if (parameters.inextensible && mobile) {
    // Under more compression the implicit response would amplify disturbances.
    options.held_tension = membrane.fine.synthesize(tension).col(0).cwiseMax(
        time_order == 1 ? 0.0 : -buckling_compression(parameters, membrane.radius));
  }
  return options;
}

/// The unknowns that charging changes.
Unknowns charge_of(const Unknowns& y) { return {{}, y.transmembrane_potential, y.free_charge, y.poration}; }

}  // namespace

StepOperations::StepOperations(const StepStart& start, Instruments& instruments)
    : start_(start), instruments_(instruments) {
  const int time_order = start.discretisation.settings().time_order;
  // The paper's scheme treats the response of the present tension to a change of H explicitly, which overshoots at
  // large tensions, as near the sphere.
  const double explicit_relaxation = time_order == 1 ? relaxation_left_explicit : 0.0;
  for (std::size_t a = 0; a < start.state.vesicles.size(); ++a) {
    const FlowParameters parameters = flow_parameters(start.model, start.model.vesicles[a]);
    const VesicleSolution& solution = start.solved.vesicles[a];
    flow_.emplace_back(parameters, *solution.membrane,
                       flow_options(parameters, start.model.mobile, start.discretisation.vesicle(a), time_order,
                                    *solution.membrane, start.solved.fields.vesicles[a].tension),
                       explicit_relaxation, solution.recycled.flow);
  }
}

template <typename Body>
void StepOperations::for_each_node(std::size_t count, const Body& body) {
  std::vector<StepWork> of_each(count);
  const auto add_up = [&] {
    for (const StepWork& of_one : of_each) work_ += of_one;
  };
  try {
    for_each_side_by_side(static_cast<Index>(count), start_.discretisation.leaves_threads_idle(), instruments_,
                          [&](Index i, Instruments& instruments) {
                            const auto m = static_cast<std::size_t>(i);
                            NodeWork work{instruments, of_each[m]};
                            body(m, work);
                          });
  } catch (const ConvergenceError&) {
    add_up();
    throw;
  }
  add_up();
}

std::vector<Rate> StepOperations::rates(std::span<const NodeSolution> nodes) {
  std::vector<Rate> result(nodes.size());
  for_each_node(nodes.size(), [&](std::size_t m, NodeWork& work) { result[m] = rate(nodes[m], work); });
  return result;
}

Rate StepOperations::rate(const NodeSolution& node, NodeWork& work) const {
  ++work.counted.evaluations;
  const SolvedFields solved = solve_fields(start_.model, start_.discretisation, material_state(start_, node),
                                           work.instruments, &start_.solved, Limit::before);
  work.counted.iterations_flow += solved.iterations_flow;
  work.counted.iterations_electric += solved.iterations_electric;
  return rate_of(solved);
}

std::vector<NodeSolution> StepOperations::first_order_steps(const std::vector<FirstOrderStep>& steps) {
  for (const FirstOrderStep& step : steps) prepare(step.dt);
  std::vector<NodeSolution> result(steps.size());
  for_each_node(steps.size(), [&](std::size_t m, NodeWork& work) { result[m] = first_order_step(steps[m], work); });
  return result;
}

std::vector<NodeSolution> StepOperations::implicit_solves(const std::vector<ImplicitSolve>& solves) {
  for (const ImplicitSolve& solve : solves) prepare(solve.dt);
  std::vector<NodeSolution> result(solves.size());
  for_each_node(solves.size(), [&](std::size_t m, NodeWork& work) { result[m] = implicit_solve(solves[m], work); });
  return result;
}

/// Makes the systems of this step size, so that threads only look them up.
void StepOperations::prepare(double dt) {
  if (!start_.model.mobile) return;
  for (const std::size_t a : partition().local_indices(flow_.size())) {
    if (!start_.solved.vesicles[a].is_sphere) static_cast<void>(flow_[a].of(dt));
  }
}

NodeSolution StepOperations::first_order_step(const FirstOrderStep& step, NodeWork& work) {
  const double dt = step.dt;
  NodeSolution result{start_.state.time + dt, {}};
  std::vector<Unknowns> charges;
  for (const VesicleState& vesicle : start_.state.vesicles) charges.push_back(charge_of(vesicle));
  charges = charged(charges, nullptr, result.time, dt, work);
  std::vector<MotionStart> starts;
  for (std::size_t a = 0; a < start_.state.vesicles.size(); ++a) {
    SurfaceFields fields = start_.state.vesicles[a];
    take(std::move(charges[a]), result.time, a, fields);
    const VesicleFields& instantaneous = start_.solved.fields.vesicles[a];
    if (start_.model.mobile) fields.tension = instantaneous.tension;
    starts.push_back({std::move(fields), instantaneous.velocity});
  }
  const RigidMotion rigid = [&](std::size_t a, const Membrane& sphere) {
    return motion_of_velocity(sphere, start_.solved.fields.vesicles[a].velocity, dt);
  };
  result.vesicles = motions(starts, rigid, dt, step.end, work);
  return result;
}

NodeSolution StepOperations::implicit_solve(const ImplicitSolve& solve, NodeWork& work) {
  const NodeSolution& y = *solve.y;
  const std::vector<Unknowns>& r = solve.r;
  const double dt = solve.dt;
  NodeSolution result{y.time, {}};
  std::vector<Unknowns> charges;
  for (const Motion& motion : y.vesicles) charges.push_back(charge_of(motion.material));
  charges = charged(charges, &r, y.time, dt, work);
  std::vector<MotionStart> starts;
  for (std::size_t a = 0; a < start_.state.vesicles.size(); ++a) {
    SurfaceFields fields = y.vesicles[a].material;
    fields.area_strain = start_.state.vesicles[a].area_strain;
    take(std::move(charges[a]), result.time, a, fields);
    starts.push_back({std::move(fields), r[a].position / dt});
  }
  // A rigid motion has no stiffness, so nothing of it is implicit.
  const RigidMotion rigid = [&](std::size_t a, const Membrane& sphere) {
    return motion_of_displacement(sphere,
                                  y.vesicles[a].material.position + r[a].position - start_.state.vesicles[a].position);
  };
  result.vesicles = motions(starts, rigid, dt, solve.end, work);
  return result;
}

std::vector<Unknowns> StepOperations::charged(const std::vector<Unknowns>& from, const std::vector<Unknowns>* residual,
                                              double time, double dt, NodeWork& work) const {
  std::vector<Unknowns> reached = from;
  if (!start_.model.electric) return reached;
  const auto timer = work.instruments.time("electric");
  if (!charges()) {
    // V_m does not change, but pores still close under it.
    for (std::size_t a = 0; a < from.size(); ++a) {
      if (!start_.model.vesicles[a].reaction) continue;
      reached[a].poration =
          react(*start_.model.vesicles[a].reaction, start_.solved.vesicles[a].membrane->fine, dt, from[a],
                residual == nullptr ? nullptr : &(*residual)[a], from[a].transmembrane_potential);
    }
    return reached;
  }
  std::vector<ChargingMembrane> membranes;
  for (std::size_t a = 0; a < from.size(); ++a) {
    const VesicleModel& vesicle = start_.model.vesicles[a];
    membranes.push_back(
        {{electric_parameters(start_.model, vesicle).at(time, Limit::before), *start_.solved.vesicles[a].membrane},
         vesicle.charging,
         vesicle.reaction.get()});
  }
  const SolveReport report =
      charge_membranes(membranes, *start_.solved.interaction, dt, start_.discretisation.settings().electric_tolerance,
                       from, residual, reached);
  work.counted.iterations_electric += report.iterations;
  require_converged(report, "membrane charging, Eq. (30)");
  return reached;
}

void StepOperations::take(Unknowns charged, double time, std::size_t a, SurfaceFields& fields) const {
  if (charges()) {
    clear_decayed(time, a, charged.transmembrane_potential);
    if (charged.free_charge.size() > 0) clear_decayed(time, a, charged.free_charge);
  }
  fields.transmembrane_potential = std::move(charged.transmembrane_potential);
  fields.free_charge = std::move(charged.free_charge);
  fields.poration = std::move(charged.poration);
}

/// Sets a decayed potential to zero, so that the electric part becomes inactive.
void StepOperations::clear_decayed(double time, std::size_t a, Vector& potential) const {
  if (start_.model.vesicles[a].pump) return;
  const double scale = start_.model.electric->field.norm() * start_.solved.vesicles[a].membrane->radius;
  if (start_.model.electric->waveform.is_quiet(time) && potential.norm() < decayed_potential * scale)
    potential.setZero();
}

State StepOperations::end_state(const NodeSolution& node) const {
  State state = state_at(start_, node);
  std::vector<SentScalars> flow(state.vesicles.size());
  for (const std::size_t a : partition().local_indices(flow.size())) flow[a] = SentScalars{flow_[a].recycled()};
  // Recycled subspaces of images are not used, so they are not sent.
  partition().gather(flow, [](const SentScalars&, std::size_t) { return SentScalars{}; });
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    state.vesicles[a].recycled = after_step(start_.solved.vesicles[a].recycled, flow[a].known, work_.iterations_flow);
  }
  return state;
}

namespace {

/// A motion with its iterations, or the reason why it failed.
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
      if (!is_finite(of_one.motion.arrived)) throw ConvergenceError("the new state is not finite");
    } catch (const ConvergenceError& error) {
      of_one.failure = error.what();
      throw;
    }
  };
  partition().ranks().collective([&] {
    try {
      for_each_member(partition().local_indices(all.size()), work.instruments, move);
    } catch (const ConvergenceError&) {
      // Thrown below, where all ranks know the first vesicle that failed.
    }
    partition().gather(all, [this](const CountedMotion& of_original, std::size_t a) -> CountedMotion {
      const ImageOfFields& image = start_.discretisation.symmetry().exchange.image(a);
      Motion motion = of_original.motion;
      for (SurfaceFields* fields : {&motion.material, &motion.arrived}) *fields = image_of(image, *fields);
      return {std::move(motion)};
    });
  });
  std::vector<Motion> result;
  for (CountedMotion& of_one : all) {
    // Iterations of failed solves count as well.
    work.counted.iterations_flow += of_one.iterations;
    if (!of_one.failure.empty()) throw ConvergenceError(of_one.failure);
    result.push_back(std::move(of_one.motion));
  }
  return result;
}

Motion StepOperations::motion(std::size_t a, const MotionStart& start, const RigidMotion& rigid, double dt, NodeEnd end,
                              Instruments& instruments, int& iterations) {
  const VesicleSolution& solution = start_.solved.vesicles[a];
  if (!start_.model.mobile) {
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
                         : at_translated_nodes(start_.state.vesicles[a].position, sphere, moved, result.material);
    return result;
  }
  const FlowParameters parameters = flow_parameters(start_.model, start_.model.vesicles[a]);
  return constrained_motion(
      {parameters, start_.discretisation.settings(), start_.state.vesicles[a], *solution.membrane}, start, dt,
      flow_[a].of(dt), arrival(a, end, instruments), iterations);
}

Arrival StepOperations::arrival(std::size_t a, NodeEnd end, Instruments& instruments) const {
  if (end == NodeEnd::material) return [](const SurfaceFields& material) { return material; };
  return [this, a, &instruments](const SurfaceFields& material) {
    const auto timer = instruments.time("remap");
    return remap(start_.discretisation.vesicle(a).fine_transform(),
                 material.position - start_.state.vesicles[a].position, material);
  };
}

}  // namespace vehd
