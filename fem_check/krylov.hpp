#pragma once

#include "fem_check/lanes.hpp"
// lanes.hpp must come first.
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/solver_minres.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// √(r · P r): size of a residual in the norm of its preconditioner P. P approximates the inverse of the energy form,
/// so this approximates the energy norm of the error for any contrast of the coefficients.
template <typename Preconditioner, typename VectorType>
double energy_of_residual(const Preconditioner& preconditioner, const VectorType& residual) {
  VectorType preconditioned(residual);
  preconditioner.vmult(preconditioned, residual);
  return std::sqrt(std::max(0.0, preconditioned * residual));
}

/// Maximum of iterations, for all corrections together and for each.
constexpr int most_iterations = 3000;

/// Adds corrections to x until the true residual is small enough: the residual in a solver's recursion differs from it
/// by rounding, or is measured in another norm. A correction that is small in the solver's norm can increase the
/// energy, which decreases with the following ones.
/// @param measure  P of energy_of_residual
/// @param x        initial guess and result
/// @param goal     required value of energy_of_residual
/// @param correct  computes a correction: correct(correction, residual, its energy) returns the number of steps
/// @return         energy_of_residual at x
/// @throws SolveError if the goal is not reached within most_iterations
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
      message << "the linear solver of the " << what << " stopped at a residual of " << size << " after " << steps
              << " iterations; required: " << goal;
      throw SolveError(message.str());
    }
    VectorType correction(x);
    correction = 0.0;
    // Counts at least one step, so that the loop ends.
    steps += std::max(1, correct(correction, residual, size));
    x += correction;
    size = size_now();
  }
  iterations += steps;
  return size;
}

/// Steps of a solver, converged or not: the caller computes the true residual.
template <typename Solve>
int steps_of(const dealii::SolverControl& control, const Solve& solve) {
  try {
    solve();
  } catch (const dealii::SolverControl::NoConvergence&) {
  }
  return static_cast<int>(control.last_step());
}

/// Minimal residual method for symmetric equations in the norm of the preconditioner.
/// @param x     initial guess and result
/// @param goal  required value of energy_of_residual
/// @return      energy_of_residual at x
/// @throws SolveError if the goal is not reached
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

/// Generalised minimal residual method: as minimal_residuals, but the preconditioner need not be symmetric.
/// @param measure         P of energy_of_residual
/// @param preconditioner  approximate inverse
template <typename Operator, typename Measure, typename Preconditioner, typename VectorType>
double generalised_minimal_residuals(const Operator& a, const Measure& measure, const Preconditioner& preconditioner,
                                     const VectorType& b, VectorType& x, double goal, int& iterations,
                                     const char* what) {
  constexpr unsigned most_directions = 100;
  // The solver uses the Euclidean norm of the preconditioned residual, which can decrease slightly while the energy
  // does not: even near the goal a correction therefore reduces it at least tenfold.
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
