#pragma once

namespace vehd {

/// A 2:1 prolate pulled through a viscous fluid: the Stokes single layer on a density with known velocity.
/// Source: Kim and Karrila 1991, see ProlateSpeeds
struct ProlateResult {
  double error = 0.0;  ///< largest deviation from the exact velocity over the nodes and both directions, over the speed
  double seconds = 0.0;        ///< operator and both velocities; tables of the order excluded
  double first_seconds = 0.0;  ///< tables included
};

/// The poles of the grid are off the axis of the prolate, which nothing but the truncation can see.
ProlateResult solve_translating_prolate(int order);

}  // namespace vehd
