#pragma once

#include <vector>

#include "bie/sphere/transform.hpp"

namespace vehd {

/// Layers of one membrane at far points by the smooth rule of one grid.
/// Accuracy: of the rule, see smooth_sums
/// Source: paper Eqs. (6), (8), (9), (22)
class FarRule {
 public:
  /// @param position    coefficients of the membrane, [n_coefficients x 3]
  /// @param nodes       from that degree to the grid
  FarRule(const Matrix& position, const SphereTransform& nodes);
  /// The same on a grid of its own. @param grid_order  not below the degree of the membrane
  FarRule(const Matrix& position, int grid_order);

  /// A density at the nodes times their weights. @param density  [n_coefficients x fields] @return [n x fields]
  [[nodiscard]] Matrix charges(const Matrix& density) const;

  /// Sums over the nodes for targets with normals N there, [n_targets x 3], prefactors included: S, N·∇S of J f; D,
  /// N·∇D of f.
  /// @param points   targets, [n_targets x 3]
  /// @param charges  of J f or f
  [[nodiscard]] Vector laplace_single(const Matrix& points, const Matrix& charges) const;
  [[nodiscard]] Vector laplace_single_normal(const Matrix& points, const Matrix& normals, const Matrix& charges) const;
  [[nodiscard]] Vector laplace_double(const Matrix& points, const Matrix& charges) const;
  [[nodiscard]] Vector laplace_double_normal(const Matrix& points, const Matrix& normals, const Matrix& charges) const;
  /// Stokes single layer at μ = 1 of J f and double layer of v. @param charges  [n x 3] @return [n_targets x 3]
  [[nodiscard]] Matrix stokes_single(const Matrix& points, const Matrix& charges) const;
  [[nodiscard]] Matrix stokes_double(const Matrix& points, const Matrix& charges) const;

  /// Layers at several targets as rows over the coefficients of their densities: quadrature and the adjoint of the
  /// synthesis in one. N·∇S and N·∇D. @param points, normals  [n_targets x 3] @return [n_coefficients x n_targets]
  [[nodiscard]] Matrix single_normal_rows(const Matrix& points, const Matrix& normals) const;
  [[nodiscard]] Matrix double_normal_rows(const Matrix& points, const Matrix& normals) const;
  /// The Stokes double layer. @return [n_coefficients x 6] of xx, xy, xz, yy, yz, zz, of one target behind the other
  [[nodiscard]] Matrix stokes_double_rows(const Matrix& points) const;

  /// D[1] at targets: 0 outside, −1 inside, up to the error of the rule.
  [[nodiscard]] Vector enclosures(const Matrix& points) const;
  [[nodiscard]] Index n_nodes() const { return n_nodes_; }

 private:
  template <class Kernel>
  [[nodiscard]] Matrix normal_rows(const Matrix& points, const Matrix& normals) const;

  SphereTransform transform_;
  Index n_nodes_;
  Matrix nodes_;   ///< y and J n, filled up to whole instructions, [n x 6]
  Vector weight_;  ///< zero for those
};

}  // namespace vehd
