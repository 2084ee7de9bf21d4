#include "bie/stepping/solve/flow_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Most iterations of one solve. Shapes unlike the preconditioner's sphere (1 : 1 : 5, degree 64) need sixty.
constexpr int most_flow_iterations = 120;
/// Number of systems that a step keeps, one for each step size: twice as many as a scheme needs for its nodes. Times
/// within a step have sizes of their own that do not recur.
constexpr std::size_t most_flow_systems = 12;

StackedEntries stacked_rows(const std::vector<FlowEquations>& equations) {
  StackedEntries result;
  for (const FlowEquations& one : equations) result.add(one.size(), 1);
  return result;
}

StackedEntries stacked_velocities(const std::vector<FlowEquations>& equations, const std::vector<std::size_t>& own) {
  StackedEntries result;
  for (const std::size_t a : own) result.add(n_coefficients(equations[a].membrane().fine.order()), 3);
  return result;
}

/// The recycled subspaces; all are empty unless each fits its equations and all have the same number of columns.
std::vector<RecycledSubspace> suitable(const std::vector<FlowEquations>& equations,
                                       std::vector<RecycledSubspace> recycled) {
  const auto fits = [&](std::size_t a) {
    return recycled[a].count() == recycled.front().count() && recycled[a].arguments.rows() == equations[a].size();
  };
  bool all = recycled.size() == equations.size();
  for (std::size_t a = 0; a < equations.size() && all; ++a) all = fits(a);
  if (!all) recycled.assign(equations.size(), {});
  return recycled;
}

}  // namespace

FlowSystem::FlowSystem(std::vector<FlowEquations> equations, MembraneFlow& flow, std::vector<RecycledSubspace> recycled)
    : equations_(std::move(equations)),
      flow_(flow),
      own_(flow.partition().local_indices(equations_.size())),
      rows_(stacked_rows(equations_)),
      own_velocities_(stacked_velocities(equations_, own_)),
      recycled_(suitable(equations_, std::move(recycled))),
      solver_([this](const Vector& v) { return map(v); }, [this](const Vector& r) { return preconditioned(r); },
              rows_.size(), own_velocities_.size(), stacked_subspace()) {}

/// Left sides followed by the velocities, so that the velocities of a solution need no further application.
Vector FlowSystem::map(const Vector& v) const {
  const std::vector<Vector> parts = rows_.fields<Vector>(v);
  std::vector<Matrix> weighted(equations_.size());
  for_each_member(own_, [&](std::size_t a) {
    const Matrix force = equations_[a].force(equations_[a].unknowns(parts[a]));
    if (force.size() > 0) weighted[a] = equations_[a].membrane().weighted(force);
  });
  const std::vector<Matrix> velocities = flow_.velocities(weighted);
  std::vector<Vector> sides(equations_.size());
  for_each_member(own_, [&](std::size_t a) { sides[a] = equations_[a].left_side(velocities[a], parts[a]); });
  gather(sides);
  std::vector<Matrix> own;
  for (const std::size_t a : own_) own.push_back(velocities[a]);
  Vector result(rows_.size() + own_velocities_.size());
  result << rows_.stack(sides), own_velocities_.stack(own);
  return result;
}

Vector FlowSystem::preconditioned(const Vector& residual) const {
  std::vector<Vector> parts = rows_.fields<Vector>(residual);
  if (are_many(std::ssize(parts))) {
    for_each_member(own_, [&](std::size_t a) { parts[a] = equations_[a].approximate_inverse(parts[a]); });
    gather(parts);
  } else {
    // With few membranes every rank computes all of them.
    for (std::size_t a = 0; a < parts.size(); ++a) parts[a] = equations_[a].approximate_inverse(parts[a]);
  }
  return rows_.stack(parts);
}

void FlowSystem::gather(std::vector<Vector>& rows) const {
  flow_.partition().gather(rows, [&](const Vector& of_original, std::size_t a) {
    return equations_[a].image(flow_.exchange().image(a), of_original);
  });
}

FlowSystem::Solution FlowSystem::solve(const std::vector<Vector>& right_sides, double tolerance, double least_size) {
  const RecycledGcr::Solution solution =
      solver_.solve(rows_.stack(right_sides), {}, {tolerance, most_flow_iterations}, least_size);
  Solution result{solution.report, {}, std::vector<Matrix>(equations_.size()), solution.size_of_rhs};
  const std::vector<Vector> parts = rows_.fields<Vector>(solution.x);
  for (std::size_t a = 0; a < parts.size(); ++a) result.unknowns.push_back(equations_[a].unknowns(parts[a]));
  std::vector<Matrix> own = own_velocities_.fields<Matrix>(solution.further);
  for (std::size_t i = 0; i < own.size(); ++i) result.velocities[own_[i]] = std::move(own[i]);
  return result;
}

const FlowSystem::Solution& FlowSystem::of_uniform_tension(double tolerance) {
  if (of_uniform_tension_) return *of_uniform_tension_;
  const FlowEquations& one = equations_.front();
  FlowScalars uniform = one.unknowns(Vector::Zero(one.size()));
  uniform.tension[0] = coefficient_of_one;
  const Matrix velocity = flow_.velocities({one.membrane().weighted(one.force(uniform))}).front();
  of_uniform_tension_ = solve({-one.left_side(velocity)}, tolerance);
  of_uniform_tension_->velocities.front() += velocity;
  of_uniform_tension_->unknowns.front().tension += uniform.tension;
  return *of_uniform_tension_;
}

double FlowSystem::size_of(const std::vector<FlowScalars>& unknowns) const {
  double sum = 0.0;
  for (std::size_t a = 0; a < equations_.size(); ++a) {
    sum += equations_[a].without_mean(equations_[a].over_scales(unknowns[a])).squaredNorm();
  }
  return std::sqrt(sum);
}

RecycledSubspace FlowSystem::stacked_subspace() const {
  const Index columns = recycled_.front().count();
  if (columns == 0) return {};
  RecycledSubspace all{Matrix(rows_.size(), columns), Matrix(rows_.size(), columns)};
  for (std::size_t a = 0; a < equations_.size(); ++a) {
    const RecycledSubspace of_one = equations_[a].in_system(recycled_[a]);
    all.arguments.middleRows(rows_.first(a), equations_[a].size()) = of_one.arguments;
    all.responses.middleRows(rows_.first(a), equations_[a].size()) = of_one.responses;
  }
  return all;
}

std::vector<RecycledSubspace> FlowSystem::found() const {
  const RecycledSubspace all = solver_.found();
  std::vector<RecycledSubspace> result;
  for (std::size_t a = 0; a < equations_.size(); ++a) {
    const Index first = rows_.first(a), count = equations_[a].size();
    result.push_back(
        equations_[a].in_scalars({all.arguments.middleRows(first, count), all.responses.middleRows(first, count)}));
  }
  return result;
}

std::vector<RecycledSubspace> FlowSystem::kept() const {
  std::vector<RecycledSubspace> result;
  for (const RecycledSubspace& one : recycled_) result.push_back(selected(one, solver_.kept()));
  return result;
}

FlowSystems::FlowSystems(const FlowParameters& parameters, const Membrane& membrane, FlowOptions options,
                         double explicit_relaxation, std::shared_ptr<const RecycledScalars> recycled)
    : alone_{{parameters, membrane}},
      flow_(alone_, none_),
      options_(std::move(options)),
      // An ellipsoidal disturbance of a sphere relaxes under a tension λ at the rate 24 λ/((32 + 23 μ_i/μ_e) μ_e R)
      // (quasi-spherical theory).
      explicit_tension_time_(explicit_relaxation * (32.0 + 23.0 * parameters.viscosity_ratio) / 24.0 *
                             parameters.viscosity * membrane.radius),
      recycled_(std::move(recycled)) {}

FlowSystem& FlowSystems::of(double dt) {
  for (auto& [size, system] : systems_) {
    if (size == dt) return *system;
  }
  const std::shared_ptr<const RecycledScalars> so_far = recycled();
  const FlowParameters& parameters = alone_.front().parameters;
  const Index n_scalars = (parameters.bending ? 1 : 0) + (parameters.inextensible ? 1 : 0);
  FlowOptions options = options_;
  options.dt = dt;
  Vector& held = options.held_tension;
  held = (held.array() - explicit_tension_time_ / dt).cwiseMax(held.array().cwiseMin(0.0));
  if (held.isZero(0.0)) held.resize(0);
  std::vector<FlowEquations> equations;
  equations.emplace_back(alone_.front(), std::move(options));
  std::vector<RecycledSubspace> known;
  if (so_far) known.push_back(so_far->in(options_.entries, n_scalars));
  if (systems_.size() == most_flow_systems) systems_.pop_front();
  systems_.emplace_back(dt, std::make_unique<FlowSystem>(std::move(equations), flow_, std::move(known)));
  return *systems_.back().second;
}

std::shared_ptr<const RecycledScalars> FlowSystems::recycled() const {
  if (systems_.empty()) return recycled_;
  RecycledSubspace all = systems_.front().second->kept().front();
  for (const auto& [size, system] : systems_) all = joined(system->found().front(), all, thresholds::most_recycled);
  return recycled_scalars(options_.entries, std::move(all));
}

}  // namespace vehd
