#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bie/physics/point_sources.hpp"

namespace vehd {

/// Solution of a problem with a known answer at one degree.
struct SolvedProblem {
  double error = 0.0;    ///< relative to the largest value of the field
  double seconds = 0.0;  ///< without tables of the degree, as for every solution but the first
};

/// Peak memory of a solution beyond what the process held before, see MemoryMeter; nothing if the system does not
/// report it.
std::optional<std::int64_t> memory_of(const std::function<void()>& solve);

/// Example 1 of the paper: Eq. (35) on shape (33) with σ_i = 2, σ_e = 1 and six point sources, solved to a relative
/// residual of 1e-10.
/// Source: paper, Example 1 and Figure 1
struct Example1Result {
  int order = 0;
  PointSourceErrors errors;  ///< over the nodes of the upsampled grid
  double seconds = 0.0;      ///< operators, solve and fields; tables of the order excluded
};

/// @param upsampling  of the grid for products and errors; 1 as in the paper: the 2(p+1)² nodes
/// @throws ConvergenceError if the solve does not converge
Example1Result solve_example1(int order, int upsampling = 1);

/// Point sources of the example.
std::vector<PointSource> example1_sources();
/// Conductivities of the example: σ_i = 2, σ_e = 1.
ElectricParameters example1_electric();
/// Shape (33) truncated to a degree, coefficients [n_coefficients x 3].
/// Source: paper Eq. (33)
Matrix example1_position(int order);

/// A 2:1 prolate pulled through a viscous fluid along and across its axis: the Stokes single layer of a density with
/// known velocity. The error is the maximum over the nodes and both directions, relative to the speed. The poles of the
/// grid are off the axis of the prolate, which affects only the truncation.
/// Source: Kim and Karrila 1991, see ProlateSpeeds
SolvedProblem solve_translating_prolate(int order);

}  // namespace vehd
