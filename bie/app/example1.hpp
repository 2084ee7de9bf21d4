#pragma once

namespace vehd {

/// Example 1 of the paper: Eq. (35) on shape (33) with σ_i = 2, σ_e = 1 and six point sources.
struct Example1Result {
  int order = 0;
  double error_q = 0.0;      ///< relative max error of q over the 2(p+1)² nodes of the discretisation
  double error_force = 0.0;  ///< the same of f_E
  int iterations = 0;        ///< GMRES, to a relative residual of 1e-10
  double seconds = 0.0;      ///< operators, solve and fields; tables of the order excluded
};

/// @throws ConvergenceError if GMRES does not converge
Example1Result solve_example1(int order);

}  // namespace vehd
