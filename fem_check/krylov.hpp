#pragma once

#include <cmath>
#include <sstream>

#include "fem_check/space.hpp"

namespace vehd::fem_check {

/// √(r · P r): the size of a residual as its preconditioner P measures it. P is close to the inverse of the energy, so
/// this is about the energy of the error, whatever the contrast of the coefficients.
template <typename Preconditioner, typename VectorType>
double energy_of_residual(const Preconditioner& preconditioner, const VectorType& residual) {
  VectorType preconditioned(residual);
  preconditioner.vmult(preconditioned, residual);
  return std::sqrt(std::max(0.0, preconditioned * residual));
}

/// Minimal residuals in the norm of the preconditioner, started again from the true residual until that one is small
/// enough too: the recursion alone drifts away from it by rounding.
/// @param x     start and result
/// @param goal  what energy_of_residual has to fall to
/// @return      its value at x
/// @throws SolveError if it does not
template <typename Operator, typename Preconditioner, typename VectorType>
double minimal_residuals(const Operator& a, const Preconditioner& preconditioner, const VectorType& b, VectorType& x,
                         double goal, int& iterations, const char* what) {
  constexpr unsigned most_iterations = 3000;
  VectorType residual(b);
  const auto size_now = [&] {
    a.vmult(residual, x);
    residual.sadd(-1.0, 1.0, b);
    const double size = energy_of_residual(preconditioner, residual);
    if (!std::isfinite(size)) throw SolveError(std::string("the equations of the ") + what + " are not finite");
    return size;
  };
  double size = size_now();
  while (size > goal) {
    VectorType correction(x);
    correction = 0.0;
    dealii::SolverControl control(most_iterations, 0.5 * goal);
    dealii::SolverMinRes<VectorType> solver(control);
    try {
      solver.solve(a, correction, residual, preconditioner);
    } catch (const dealii::SolverControl::NoConvergence&) {
      // The true residual says below what was reached.
    }
    iterations += static_cast<int>(control.last_step());
    x += correction;
    const double before = size;
    size = size_now();
    if (size > goal && size > 0.5 * before) {
      std::ostringstream message;
      message << "minimal residuals of the " << what << " stopped at the residual " << size << " after " << iterations
              << " iterations; asked for " << goal;
      throw SolveError(message.str());
    }
  }
  return size;
}

}  // namespace vehd::fem_check
