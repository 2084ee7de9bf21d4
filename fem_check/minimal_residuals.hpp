#pragma once

#include <cmath>
#include <sstream>

#include "fem_check/saddle_point.hpp"

namespace vehd::fem_check {

/// Minimal residuals from zero for a symmetric operator and a symmetric positive definite preconditioner.
/// @throws SolveError if the residual, in the norm of the preconditioner, does not fall to `tolerance` times that of
///     zero
template <typename Operator, typename Preconditioner>
Blocks minimal_residuals(const Operator& matrix, const Preconditioner& preconditioner, const Blocks& b,
                         double tolerance, int& iterations) {
  Blocks x(b);
  x = 0.0;
  Blocks preconditioned(x);
  preconditioner.vmult(preconditioned, b);
  const double norm = std::sqrt(std::max(0.0, preconditioned * b));
  if (!std::isfinite(norm)) throw SolveError("the right-hand side of the flow is not finite");
  if (norm == 0.0) return x;
  dealii::SolverControl control(3000, tolerance * norm);
  dealii::SolverMinRes<Blocks> solver(control);
  try {
    solver.solve(matrix, x, b, preconditioner);
  } catch (const dealii::SolverControl::NoConvergence& failure) {
    std::ostringstream message;
    message << "minimal residuals stopped after " << failure.last_step << " iterations at the residual "
            << failure.last_residual / norm << " relative to the start; asked for " << tolerance;
    throw SolveError(message.str());
  }
  iterations += static_cast<int>(control.last_step());
  return x;
}

}  // namespace vehd::fem_check
