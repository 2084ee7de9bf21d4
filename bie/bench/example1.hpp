#pragma once

#include <vector>

#include "bie/physics/point_sources.hpp"

namespace vehd {

/// Example 1 of the paper: Eq. (35) on shape (33) with σ_i = 2, σ_e = 1 and six point sources.
/// Source: paper, Example 1 and Figure 1
struct Example1Result {
  int order = 0;
  PointSourceErrors errors;    ///< over the nodes of the upsampled grid
  double seconds = 0.0;        ///< operators, solve and fields; tables of the order excluded
  double first_seconds = 0.0;  ///< tables included
};

/// @param upsampling  of the grid on which products are formed and errors taken; 1 as in the paper: the 2(p+1)² nodes
/// @param tolerance   of GMRES, relative
/// @throws ConvergenceError if GMRES does not converge
Example1Result solve_example1(int order, int upsampling = 1, double tolerance = 1e-10);

/// Results of the example.
std::vector<PointSource> example1_sources();
/// Conductivities of the example: σ_i = 2, σ_e = 1.
ElectricParameters example1_electric();
/// Shape (33) truncated to a degree, coefficients [n_coefficients x 3].
/// Source: paper Eq. (33)
Matrix example1_position(int order);

}  // namespace vehd
