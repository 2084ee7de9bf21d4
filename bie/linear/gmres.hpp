#pragma once

#include <functional>
#include <string>

#include "bie/support/types.hpp"

namespace vehd {

using LinearMap = std::function<Vector(const Vector&)>;

struct GmresOptions {
  double tolerance = 1e-10;  ///< of the preconditioned residual relative to the preconditioned right-hand side
  int max_iterations = 100;
};

/// How a solve ended. `residual` is relative, in the norm of GmresOptions::tolerance.
struct SolveReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0.0;
};

/// Solves map(x) = rhs by left-preconditioned GMRES (Eigen's), starting from the x given.
/// @param preconditioner  approximate inverse of `map`
SolveReport gmres(const LinearMap& map, const LinearMap& preconditioner, const Vector& rhs, Vector& x,
                  const GmresOptions& options);

/// @throws ConvergenceError "WHAT: residual ... after ... iterations" unless the report says converged
void require_converged(const SolveReport& report, const std::string& what);

}  // namespace vehd
