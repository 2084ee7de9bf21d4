#pragma once

#include <vector>

#include "bie/linear/solve_report.hpp"

namespace vehd {

/// Solves map(x) = rhs by RecycledGcr, from the x given, where only some entries can differ from zero, as those of
/// symmetric fields: neither `map` nor `preconditioner` leaves that subspace but by rounding, which is cut off, and the
/// search directions have no more entries than it. Entries outside it are zero in the solution.
/// @param entries         ascending
/// @param preconditioner  approximate inverse of `map`
/// Accuracy: the tolerance asked for; the residual that is reported is the preconditioned one
/// (tests/linear/subspace_solve_test.cpp)
/// Source: Eisenstat, Elman and Schultz 1983, see RecycledGcr
SolveReport solve_within(const std::vector<Index>& entries, const LinearMap& map, const LinearMap& preconditioner,
                         const Vector& rhs, Vector& x, const SolveOptions& options);

}  // namespace vehd
