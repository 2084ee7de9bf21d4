#pragma once

#include <vector>

#include "bie/potentials/near_rows.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// Layers of one membrane at far points by the smooth rule of one grid.
/// Accuracy: that of the rule, see smooth_sums
/// Source: paper Eqs. (6), (8), (9), (22)
class FarRule {
 public:
  /// @param position  coefficients of the membrane, [n_coefficients x 3]
  /// @param nodes     transform from the membrane's degree to the grid of the rule
  FarRule(const Matrix& position, const SphereTransform& nodes);
  /// @param position    coefficients of the membrane, [n_coefficients x 3]
  /// @param grid_order  degree of the grid of the rule, not below that of the membrane
  FarRule(const Matrix& position, int grid_order);

  /// A density at the nodes times their weights.
  /// @param density  [n_coefficients x fields]
  /// @return         [n x fields], n the number of nodes padded to whole registers
  [[nodiscard]] Matrix charges(const Matrix& density) const;

  /// A layer at targets with normals N by sums over the nodes, prefactors included.
  /// @param points, normals   [n_targets x 3]
  /// @param charges           of the density, see charges()
  /// @param plane             for images
  /// @return                  [n_targets x 1], of a Stokes layer [n_targets x 3]
  [[nodiscard]] Matrix sums(PairLayer layer, const Matrix& points, const Matrix& normals, const Matrix& charges,
                            const MirrorPlane& plane = {}) const;

  /// A layer at several targets as rows over the coefficients of its density: quadrature and adjoint synthesis
  /// combined. For N·∇S, N·∇D and the Stokes double layer only.
  /// @return [n_coefficients x n_targets * n_rows(layer)], the rows of each target as columns
  [[nodiscard]] Matrix rows(PairLayer layer, const Matrix& points, const Matrix& normals) const;

  /// D[1] at targets, [n_targets]: 0 outside, −1 inside, up to the error of the rule.
  /// @param points  [n_targets x 3]
  [[nodiscard]] Vector enclosures(const Matrix& points) const;

 private:
  SphereTransform transform_;
  Index n_nodes_;
  Matrix nodes_;   ///< y and J n, padded to whole registers, [n x 6]
  Vector weight_;  ///< zero for padding
};

}  // namespace vehd
