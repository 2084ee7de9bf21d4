#pragma once

#include "fem_check/lanes.hpp"
// Lanes first.
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/solver_minres.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// √(r · P r): the size of a residual as its preconditioner P measures it. P is close to the inverse of the energy, so
/// this is about the energy of the error, whatever the contrast of the coefficients.
template <typename Preconditioner, typename VectorType>
double energy_of_residual(const Preconditioner& preconditioner, const VectorType& residual) {
  VectorType preconditioned(residual);
  preconditioner.vmult(preconditioned, residual);
  return std::sqrt(std::max(0.0, preconditioned * residual));
}

/// Of all corrections together, and of each.
constexpr int most_iterations = 3000;

/// Adds corrections to x until the true residual is small enough: the recursion of a solver alone drifts away from it
/// by rounding, or measures it differently. A correction that is small in the solver's own measure may raise the
/// energy, which falls with the next ones.
/// @param measure  P of energy_of_residual
/// @param x        start and result
/// @param goal     what energy_of_residual has to fall to
/// @param correct  finds a correction: correct(correction, residual, its energy), and returns its steps
/// @return         its value at x
/// @throws SolveError if it does not within most_iterations
template <typename Operator, typename Measure, typename VectorType, typename Correct>
double corrected(const Operator& a, const Measure& measure, const VectorType& b, VectorType& x, double goal,
                 int& iterations, const char* what, const Correct& correct) {
  VectorType residual(b);
  const auto size_now = [&] {
    a.vmult(residual, x);
    residual.sadd(-1.0, 1.0, b);
    const double size = energy_of_residual(measure, residual);
    if (!std::isfinite(size)) throw SolveError(std::string("the equations of the ") + what + " are not finite");
    return size;
  };
  double size = size_now();
  int steps = 0;
  while (size > goal) {
    if (steps >= most_iterations) {
      std::ostringstream message;
      message << "minimal residuals of the " << what << " stopped at the residual " << size << " after " << steps
              << " iterations; asked for " << goal;
      throw SolveError(message.str());
    }
    VectorType correction(x);
    correction = 0.0;
    // One without a step would be repeated for ever.
    steps += std::max(1, correct(correction, residual, size));
    x += correction;
    size = size_now();
  }
  iterations += steps;
  return size;
}

/// Steps that a solver took, whether it got where it should or not: the true residual says what was reached.
template <typename Solve>
int steps_of(const dealii::SolverControl& control, const Solve& solve) {
  try {
    solve();
  } catch (const dealii::SolverControl::NoConvergence&) {
  }
  return static_cast<int>(control.last_step());
}

/// Minimal residuals of symmetric equations in the norm of the preconditioner.
/// @param x     start and result
/// @param goal  what energy_of_residual has to fall to
/// @return      its value at x
/// @throws SolveError if it does not
template <typename Operator, typename Preconditioner, typename VectorType>
double minimal_residuals(const Operator& a, const Preconditioner& preconditioner, const VectorType& b, VectorType& x,
                         double goal, int& iterations, const char* what) {
  return corrected(a, preconditioner, b, x, goal, iterations, what,
                   [&](VectorType& correction, const VectorType& residual, double /*size*/) {
                     dealii::SolverControl control(most_iterations, 0.5 * goal);
                     dealii::SolverMinRes<VectorType> solver(control);
                     return steps_of(control, [&] { solver.solve(a, correction, residual, preconditioner); });
                   });
}

/// Generalised minimal residuals: as minimal_residuals, with a preconditioner that need not be symmetric.
/// @param measure         P of energy_of_residual
/// @param preconditioner  approximate inverse
template <typename Operator, typename Measure, typename Preconditioner, typename VectorType>
double generalised_minimal_residuals(const Operator& a, const Measure& measure, const Preconditioner& preconditioner,
                                     const VectorType& b, VectorType& x, double goal, int& iterations,
                                     const char* what) {
  constexpr unsigned most_directions = 100;
  // The solver measures the preconditioned residual node by node, which may fall a little without the energy: from a
  // start that is nearly good enough a correction reduces it to a tenth at least as well.
  constexpr double largest_reduction = 0.1;
  return corrected(
      a, measure, b, x, goal, iterations, what, [&](VectorType& correction, const VectorType& residual, double size) {
        dealii::ReductionControl control(most_iterations, 0.0, 0.5 * std::min(goal / size, largest_reduction));
        typename dealii::SolverGMRES<VectorType>::AdditionalData data(most_directions + 2);
        dealii::SolverGMRES<VectorType> solver(control, data);
        return steps_of(control, [&] { solver.solve(a, correction, residual, preconditioner); });
      });
}

}  // namespace vehd::fem_check
