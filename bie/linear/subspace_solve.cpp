#include "bie/linear/subspace_solve.hpp"

#include <utility>

#include "bie/linear/recycled_gcr.hpp"

namespace vehd {

SolveReport solve_within(const std::vector<Index>& entries, const LinearMap& map, const LinearMap& preconditioner,
                         const Vector& rhs, Vector& x, const SolveOptions& options) {
  const auto expanded = [&](const Vector& within) {
    Vector all = Vector::Zero(rhs.size());
    all(entries) = within;
    return all;
  };
  const auto restricted = [&](const LinearMap& of_all) -> LinearMap {
    return [&](const Vector& within) -> Vector { return of_all(expanded(within))(entries); };
  };
  RecycledGcr solver(restricted(map), restricted(preconditioner), static_cast<Index>(entries.size()));
  const RecycledGcr::Solution solution = solver.solve(rhs(entries), x(entries), options);
  x = expanded(solution.x);
  return solution.report;
}

}  // namespace vehd
