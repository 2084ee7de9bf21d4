#pragma once

#include <vector>

#include "bie/linear/gmres.hpp"

namespace vehd {

/// gmres() where only some entries can differ from zero, as those of axisymmetric fields: neither `map` nor
/// `preconditioner` leaves that subspace but by rounding, which is cut off, and the search directions have no more
/// entries than it. Entries outside it are zero in the solution.
/// @param support  the entries, ascending; empty: all
SolveReport gmres_within(const std::vector<Index>& support, const LinearMap& map, const LinearMap& preconditioner,
                         const Vector& rhs, Vector& x, const GmresOptions& options);

}  // namespace vehd
