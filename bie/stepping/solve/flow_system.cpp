#include "bie/stepping/solve/flow_system.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

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

/// Empty ones unless all are of these equations, with the same number of columns.
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
      own_(flow.shares().own(equations_.size())),
      rows_(stacked_rows(equations_)),
      own_velocities_(stacked_velocities(equations_, own_)),
      recycled_(suitable(equations_, std::move(recycled))),
      solver_([this](const Vector& v) { return map(v); }, [this](const Vector& r) { return preconditioned(r); },
              rows_.size(), own_velocities_.size(), stacked_subspace()) {}

/// Left sides and, behind them, the velocities, so that those of a solution need no further application.
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
    // Of few membranes every rank has all.
    for (std::size_t a = 0; a < parts.size(); ++a) parts[a] = equations_[a].approximate_inverse(parts[a]);
  }
  return rows_.stack(parts);
}

void FlowSystem::gather(std::vector<Vector>& rows) const {
  flow_.shares().gather(rows, [&](const Vector& of_original, std::size_t a) {
    return equations_[a].image(flow_.exchange().image(a), of_original);
  });
}

FlowSystem::Solution FlowSystem::solve(const std::vector<Vector>& right_sides, double tolerance, double least_size) {
  const RecycledGcr::Solution solution =
      solver_.solve(rows_.stack(right_sides), {}, {tolerance, thresholds::most_flow_iterations}, least_size);
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
  uniform.tension[0] = std::sqrt(4.0 * std::numbers::pi);
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
  const RecycledSubspace all = solver_.learned();
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

}  // namespace vehd
