#include "bie/stepping/solve/tension_solve.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "bie/stepping/solve/flow_system.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Finds the preconditioners of the membranes of this rank, if there are many.
void find_inverses(std::vector<FlowEquations>& all, const std::vector<std::size_t>& own) {
  std::map<int, TensionGrid> grids;
  for (const std::size_t a : own) {
    const int order = all[a].membrane().fine.order();
    if (!grids.contains(order)) grids.emplace(order, order);
  }
  for_each_member(own, [&](std::size_t a) { all[a].find_inverse(grids.at(all[a].membrane().fine.order())); });
}

std::vector<FlowEquations> tension_equations(const std::vector<FlowMembrane>& membranes,
                                             const std::vector<bool>& is_sphere, const MembraneFlow& flow) {
  std::vector<FlowEquations> all;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    FlowOptions options;
    options.is_sphere = is_sphere[a];
    options.holds_shape = is_sphere[a] && flow.interacts();
    all.emplace_back(membranes[a], std::move(options));
  }
  if (are_many(std::ssize(all))) find_inverses(all, flow.partition().local_indices(all.size()));
  return all;
}

FlowScalars operator+(FlowScalars a, const FlowScalars& b) {
  a.shape += b.shape;
  a.tension += b.tension;
  return a;
}

}  // namespace

SolvedTensions solve_tensions(const std::vector<FlowMembrane>& membranes, const std::vector<bool>& is_sphere,
                              MembraneFlow& flow, std::vector<Matrix> weighted, const std::vector<Matrix>& background,
                              const std::vector<Vector>& start, const std::vector<RecycledSubspace>& recycled,
                              double tolerance) {
  const std::size_t n = membranes.size();
  const std::vector<std::size_t> own = flow.partition().local_indices(n);
  const bool recycles = !are_many(std::ssize(membranes)) && std::ranges::count(is_sphere, true) == 0;
  FlowSystem system(tension_equations(membranes, is_sphere, flow), flow,
                    recycles ? recycled : std::vector<RecycledSubspace>());
  std::vector<FlowScalars> first;
  for (std::size_t a = 0; a < n; ++a) first.push_back(system.equations()[a].guess(start[a]));
  for_each_member(own, [&](std::size_t a) {
    const Matrix force = system.equations()[a].force(first[a]);
    if (force.size() == 0) return;
    const Matrix of_tension = membranes[a].membrane.weighted(force);
    weighted[a] = weighted[a].size() == 0 ? of_tension : Matrix(weighted[a] + of_tension);
  });
  const std::vector<Matrix> before = flow.velocities(weighted, background);
  std::vector<Vector> left(n);
  for (const std::size_t a : own) left[a] = system.equations()[a].left_side(-before[a]);
  system.gather(left);
  SolvedTensions result;
  FlowSystem::Solution solution;
  std::vector<FlowScalars> unknowns;
  int iterations = 0;
  // If the start was much larger than the solution, the tolerance is relative to the solution instead.
  for (double size = system.size_of(first);;) {
    solution = system.solve(left, tolerance, size);
    iterations += solution.report.iterations;
    unknowns.clear();
    for (std::size_t a = 0; a < n; ++a) unknowns.push_back(first[a] + solution.unknowns[a]);
    const double found = system.size_of(unknowns);
    if (!solution.report.converged() || size <= 2.0 * found || size <= solution.size_of_rhs) break;
    size = found;
  }
  result.report = solution.report;
  result.report.iterations = iterations;
  result.recycled.resize(n);
  if (recycles) {
    const std::vector<RecycledSubspace> found = system.found(), kept = system.kept();
    for (std::size_t a = 0; a < n; ++a) result.recycled[a] = joined(found[a], kept[a], thresholds::most_recycled);
  }
  result.velocities.resize(n);
  for (const std::size_t a : own) result.velocities[a] = before[a] + solution.velocities[a];
  for (std::size_t a = 0; a < n; ++a) {
    result.force.push_back(flow.partition().is_local(a) ? system.equations()[a].force(unknowns[a]) : Matrix());
    result.tension.push_back(std::move(unknowns[a].tension));
  }
  return result;
}

}  // namespace vehd
