#pragma once

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/level_loop.hpp"
#include "fem_check/app/refinement.hpp"
#include "fem_check/app/shape_path.hpp"

namespace vehd::fem_check {

/// Settings of the advance of V_m.
struct ChargingPlan {
  int steps;  ///< between two discontinuities of the field
  SolveSettings settings;
  const ShapePath* path = nullptr;  ///< null: the shape is constant
};

/// Advances V_m from an earlier snapshot to the state of the input. If the shape moves, every step has its own mesh
/// with equal (θ, φ) at corresponding nodes of γ; V_m at a node changes by charging and by the motion of the node along
/// the membrane, dV/dt at (θ, φ) = −(σ_i ∂φ_i/∂n + G_m V)/C_m + (dx/dt − v)·∇_γ V.
class ChargingRun {
 public:
  /// @param input  must have in_time; input and refinement must outlive this object
  ChargingRun(const CheckInput& input, const Refinement& refinement);

  /// Surface field at the points of the comparison: Vm.
  /// @param space  of the shape at the end
  /// @throws SolveError, meshes::MeshError
  [[nodiscard]] Solved solve(const Discretisation& space, const ChargingPlan& plan) const;

 private:
  /// Discretisation of a shape with the degree and the points of γ of another one.
  [[nodiscard]] Discretisation discretise(const Eigen::MatrixXd& position, const Discretisation& like) const;

  const CheckInput& input_;
  const Refinement& refinement_;
  Matrix3 in_directions_;  // axes of the cube of the meshes
};

}  // namespace vehd::fem_check
