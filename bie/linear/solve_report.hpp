#pragma once

#include <functional>
#include <string>

#include "bie/support/types.hpp"

namespace vehd {

/// x ↦ A x, [size] both.
using LinearMap = std::function<Vector(const Vector&)>;

/// Stopping criteria of a solve.
struct SolveOptions {
  double tolerance = 1e-10;  ///< of the preconditioned residual relative to the preconditioned right-hand side
  int max_iterations = 100;
};

/// Why a solve ended.
enum class SolveEnd {
  converged,
  out_of_iterations,
  stagnated,  ///< no direction lowers the residual: only rounding is left, or the map is singular
  not_finite
};

/// Outcome of a solve. `residual` bounds the true relative residual, in the norm of SolveOptions::tolerance.
struct SolveReport {
  SolveEnd end = SolveEnd::stagnated;
  int iterations = 0;
  double residual = 0.0;

  [[nodiscard]] bool converged() const { return end == SolveEnd::converged; }
};

/// "converged", "out of iterations", …
std::string text_of(SolveEnd end);

/// @throws ConvergenceError unless the solve converged, with `what`, the reason, the residual and the iterations
void require_converged(const SolveReport& report, const std::string& what);

}  // namespace vehd
