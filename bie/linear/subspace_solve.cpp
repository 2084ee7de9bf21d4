#include "bie/linear/subspace_solve.hpp"

namespace vehd {

SolveReport gmres_within(const std::vector<Index>& support, const LinearMap& map, const LinearMap& preconditioner,
                         const Vector& rhs, Vector& x, const GmresOptions& options) {
  if (support.empty()) return gmres(map, preconditioner, rhs, x, options);
  const auto expanded = [&](const Vector& entries) {
    Vector all = Vector::Zero(rhs.size());
    all(support) = entries;
    return all;
  };
  const auto within = [&](const LinearMap& of_all) -> LinearMap {
    return [&](const Vector& entries) -> Vector { return of_all(expanded(entries))(support); };
  };
  Vector entries = x(support);
  const SolveReport report = gmres(within(map), within(preconditioner), rhs(support), entries, options);
  x = expanded(entries);
  return report;
}

}  // namespace vehd
