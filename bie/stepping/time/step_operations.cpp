#include "bie/stepping/time/step_operations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "bie/physics/averaged_field.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/exchange.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/side_by_side.hpp"

namespace vehd {

namespace {

/// −λ under which the softest disturbance of a sphere, an ellipsoidal one, is no longer resisted: 3κ_B/R²
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
    // Under more compression than that the implicit response would push where it should resist.
    options.held_tension = membrane.fine.synthesize(tension).col(0).cwiseMax(
        time_order == 1 ? 0.0 : -buckling_compression(parameters, membrane.radius));
  }
  return options;
}

/// What charging changes.
Unknowns charge_of(const Unknowns& y) { return {{}, y.transmembrane_potential, y.free_charge, y.poration}; }

}  // namespace

StepOperations::StepOperations(const Model& model, const Discretisation& discretisation, const State& start,
                               const SolvedFields& at_start, Instruments& instruments)
    : model_(model), discretisation_(discretisation), start_(start), at_start_(at_start), instruments_(instruments) {
  const int time_order = discretisation.settings().time_order;
  // The paper's scheme leaves explicit what a change of H does to the tension that is there, which overshoots where
  // tensions are large, as near the sphere.
  const double explicit_relaxation = time_order == 1 ? thresholds::explicit_relaxation : 0.0;
  for (std::size_t a = 0; a < start.vesicles.size(); ++a) {
    const FlowParameters parameters = flow_parameters(model, model.vesicles[a]);
    const VesicleSolution& solution = at_start.vesicles[a];
    flow_.emplace_back(parameters, *solution.membrane,
                       flow_options(parameters, model.mobile, discretisation.vesicle(a), time_order, *solution.membrane,
                                    at_start.fields.vesicles[a].tension),
                       explicit_relaxation, solution.recycled.flow);
  }
}

Rate StepOperations::rate() const { return rate_of(at_start_); }

template <typename Body>
void StepOperations::for_each_node(std::size_t count, const Body& body) {
  std::vector<Iterations> of_each(count);
  const auto add_up = [&] {
    for (const Iterations& of_one : of_each) {
      iterations_.flow += of_one.flow;
      iterations_.electric += of_one.electric;
    }
  };
  try {
    for_each_side_by_side(static_cast<Index>(count), discretisation_.leaves_threads_idle(), instruments_,
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
  evaluations_ += static_cast<int>(nodes.size());
  for_each_node(nodes.size(), [&](std::size_t m, NodeWork& work) { result[m] = rate(nodes[m], work); });
  return result;
}

Rate StepOperations::rate(const NodeSolution& node, NodeWork& work) const {
  const SolvedFields solved = solve_fields(model_, discretisation_, state_with(&Motion::material, node),
                                           work.instruments, &at_start_, Limit::before);
  work.iterations.flow += solved.iterations_flow;
  work.iterations.electric += solved.iterations_electric;
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

/// Makes the systems of this size, which threads then only look up.
void StepOperations::prepare(double dt) {
  if (!model_.mobile) return;
  for (const std::size_t a : shares().own(flow_.size())) {
    if (!at_start_.vesicles[a].is_sphere) static_cast<void>(flow_[a].of(dt));
  }
}

NodeSolution StepOperations::first_order_step(const FirstOrderStep& step, NodeWork& work) {
  const double dt = step.dt;
  NodeSolution result{start_.time + dt, {}};
  std::vector<Unknowns> charges;
  for (const VesicleState& vesicle : start_.vesicles) charges.push_back(charge_of(vesicle));
  charges = charged(charges, nullptr, result.time, dt, work);
  std::vector<MotionStart> starts;
  for (std::size_t a = 0; a < start_.vesicles.size(); ++a) {
    SurfaceFields fields = start_.vesicles[a];
    take(std::move(charges[a]), result.time, a, fields);
    const VesicleFields& instantaneous = at_start_.fields.vesicles[a];
    if (model_.mobile) fields.tension = instantaneous.tension;
    starts.push_back({std::move(fields), instantaneous.velocity});
  }
  const RigidMotion rigid = [&](std::size_t a, const Membrane& sphere) {
    return motion_of_velocity(sphere, at_start_.fields.vesicles[a].velocity, dt);
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
  for (std::size_t a = 0; a < start_.vesicles.size(); ++a) {
    SurfaceFields fields = y.vesicles[a].material;
    fields.area_strain = start_.vesicles[a].area_strain;
    take(std::move(charges[a]), result.time, a, fields);
    starts.push_back({std::move(fields), r[a].position / dt});
  }
  // A rigid motion has no stiffness, so nothing of it is implicit.
  const RigidMotion rigid = [&](std::size_t a, const Membrane& sphere) {
    return motion_of_displacement(sphere,
                                  y.vesicles[a].material.position + r[a].position - start_.vesicles[a].position);
  };
  result.vesicles = motions(starts, rigid, dt, solve.end, work);
  return result;
}

std::vector<Unknowns> StepOperations::charged(const std::vector<Unknowns>& from, const std::vector<Unknowns>* residual,
                                              double time, double dt, NodeWork& work) const {
  std::vector<Unknowns> reached = from;
  if (!model_.electric) return reached;
  const auto timer = work.instruments.time("electric");
  if (!charges()) {
    // Pores close under the V_m that there is, which does not change.
    for (std::size_t a = 0; a < from.size(); ++a) {
      if (!model_.vesicles[a].reaction) continue;
      reached[a].poration = react(*model_.vesicles[a].reaction, at_start_.vesicles[a].membrane->fine, dt, from[a],
                                  residual == nullptr ? nullptr : &(*residual)[a], from[a].transmembrane_potential);
    }
    return reached;
  }
  std::vector<ChargingMembrane> membranes;
  for (std::size_t a = 0; a < from.size(); ++a) {
    const VesicleModel& vesicle = model_.vesicles[a];
    membranes.push_back(
        {{electric_parameters(model_, vesicle).at(time, Limit::before), *at_start_.vesicles[a].membrane},
         vesicle.charging,
         vesicle.reaction.get()});
  }
  const SolveReport report = charge_membranes(membranes, *at_start_.interaction, dt,
                                              discretisation_.settings().electric_tolerance, from, residual, reached);
  work.iterations.electric += report.iterations;
  require_converged(report, "membrane charging, Eq. (30)");
  return reached;
}

void StepOperations::take(Unknowns charged, double time, std::size_t a, SurfaceFields& fields) const {
  if (charges()) {
    forget_decayed(time, a, charged.transmembrane_potential);
    if (charged.free_charge.size() > 0) forget_decayed(time, a, charged.free_charge);
  }
  fields.transmembrane_potential = std::move(charged.transmembrane_potential);
  fields.free_charge = std::move(charged.free_charge);
  fields.poration = std::move(charged.poration);
}

/// A potential this small does nothing any more, and without it the electric part becomes inactive.
void StepOperations::forget_decayed(double time, std::size_t a, Vector& potential) const {
  if (model_.vesicles[a].pump) return;
  const double scale = model_.electric->field.norm() * at_start_.vesicles[a].membrane->radius;
  if (model_.electric->waveform.is_quiet(time) && potential.norm() < thresholds::decayed_potential * scale)
    potential.setZero();
}

State StepOperations::state_with(SurfaceFields Motion::*fields, const NodeSolution& node) const {
  State state = without_past(start_);
  state.time = node.time;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    VesicleState& vesicle = state.vesicles[a];
    static_cast<SurfaceFields&>(vesicle) =
        symmetric_part(discretisation_.vesicle(a).subspace(), node.vesicles[a].*fields);
    vesicle.recycled = at_start_.vesicles[a].recycled;
  }
  return with_images(discretisation_.symmetry().exchange, std::move(state));
}

State StepOperations::passed_state(const NodeSolution& node) const {
  State state = state_with(&Motion::arrived, node);
  ++state.step;
  return state;
}

State StepOperations::end_state(const NodeSolution& node) const {
  State state = passed_state(node);
  std::vector<SentScalars> flow(state.vesicles.size());
  for (const std::size_t a : shares().own(flow.size())) flow[a] = SentScalars{flow_[a].recycled()};
  // What is known of images serves nobody.
  shares().gather(flow, [](const SentScalars&, std::size_t) { return SentScalars{}; });
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    state.vesicles[a].recycled = after_step(at_start_.vesicles[a].recycled, flow[a].known, iterations_.flow);
  }
  return state;
}

double StepOperations::potential_difference(std::size_t a, const SurfaceFields& x, const SurfaceFields& y) const {
  if (y.transmembrane_potential.size() == 0) return 0.0;
  const SphereTransform& fine = discretisation_.vesicle(a).fine_transform();
  const double size = fine.synthesize(y.transmembrane_potential).cwiseAbs().maxCoeff();
  const Matrix change = fine.synthesize(y.transmembrane_potential - x.transmembrane_potential);
  return change.cwiseAbs().maxCoeff() / potential_scale(*model_.electric, at_start_.vesicles[a].membrane->radius, size);
}

/// The state is a pure number that becomes of the order of one, or a logarithm.
double StepOperations::poration_difference(std::size_t a, const SurfaceFields& x, const SurfaceFields& y) const {
  if (y.poration.size() == 0) return 0.0;
  return discretisation_.vesicle(a).fine_transform().synthesize(y.poration - x.poration).cwiseAbs().maxCoeff();
}

double StepOperations::difference(const NodeSolution& a, const NodeSolution& b) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < start_.vesicles.size(); ++i) {
    const SphereTransform& fine = discretisation_.vesicle(i).fine_transform();
    const SurfaceFields& x = a.vesicles[i].material;
    const SurfaceFields& y = b.vesicles[i].material;
    const double moved = fine.synthesize(y.position - x.position).rowwise().norm().maxCoeff();
    largest = std::max({largest, moved / at_start_.vesicles[i].membrane->radius, potential_difference(i, x, y),
                        poration_difference(i, x, y)});
  }
  return largest;
}

double StepOperations::normal_difference(std::size_t a, const SurfaceFields& x, const SurfaceFields& y) const {
  const SphereTransform& fine = discretisation_.vesicle(a).fine_transform();
  const SphereDerivatives there = fine.synthesize_gradient(y.position);
  const Matrix change = fine.synthesize(y.position - x.position);
  double largest = 0.0;
  for (Index i = 0; i < change.rows(); ++i) {
    const Vector3 across = Vector3(there.d1.row(i)).cross(Vector3(there.d2.row(i)));
    largest = std::max(largest, std::abs(across.dot(Vector3(change.row(i)))) / across.norm());
  }
  return largest / at_start_.vesicles[a].membrane->radius;
}

VisibleDifference StepOperations::visible_difference(const NodeSolution& a, const NodeSolution& b) const {
  VisibleDifference largest;
  for (std::size_t i = 0; i < start_.vesicles.size(); ++i) {
    const SurfaceFields& x = a.vesicles[i].material;
    const SurfaceFields& y = b.vesicles[i].material;
    largest.shape = std::max(largest.shape, normal_difference(i, x, y));
    largest.potential = std::max({largest.potential, potential_difference(i, x, y), poration_difference(i, x, y)});
  }
  return largest;
}

}  // namespace vehd
