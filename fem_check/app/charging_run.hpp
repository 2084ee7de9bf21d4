#pragma once

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/level_loop.hpp"
#include "fem_check/app/refinement.hpp"
#include "fem_check/app/shape_path.hpp"

namespace vehd::fem_check {

/// How V_m is advanced.
struct ChargingPlan {
  int steps;  ///< between two discontinuities of the field
  SolveSettings settings;
  const ShapePath* path = nullptr;  ///< null: the shape stands still
};

/// V_m on its way from an earlier snapshot to the state of the input. On a shape that moves, every step has its own
/// mesh, with the same (θ, φ) at each node of γ; V_m of the nodes changes by charging and by their sliding along the
/// membrane, dV/dt at (θ, φ) = −(σ_i ∂φ_i/∂n + G_m V)/C_m + (dx/dt − v)·∇_γ V.
class ChargingRun {
 public:
  /// @param input  with in_time; both must outlive it
  ChargingRun(const CheckInput& input, const Refinement& refinement);

  /// Surface field at the points of the comparison: Vm.
  /// @param space  of the shape at the end
  /// @throws SolveError, meshes::MeshError
  [[nodiscard]] Solved solve(const Discretisation& space, const ChargingPlan& plan) const;

 private:
  /// Of a shape, with the degree and the points of γ of another discretisation.
  [[nodiscard]] Discretisation discretise(const Eigen::MatrixXd& position, const Discretisation& like) const;

  const CheckInput& input_;
  const Refinement& refinement_;
  Matrix3 in_directions_;  // of the cube of the meshes
};

}  // namespace vehd::fem_check
