#pragma once

#include <vector>

#include "bie/potentials/near_rows.hpp"
#include "bie/potentials/smooth_grid.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// Layers of one membrane at far points by the smooth rule of one grid.
/// Accuracy: of the rule, see smooth_sums
/// Source: paper Eqs. (6), (8), (9), (22)
class FarRule {
 public:
  /// @param position    coefficients of the membrane, [n_coefficients x 3]
  /// @param grid_order  of the grid, not below that of the membrane
  FarRule(const Matrix& position, int grid_order);

  /// A density at the nodes times their weights. @param density  [n_coefficients x fields] @return [n_nodes x fields]
  [[nodiscard]] Matrix charges(const Matrix& density) const;

  /// Sums over the nodes for a target x with normal N there, prefactors included: S, N·∇S of J f; D, N·∇D of f.
  /// @param charges  [n_nodes], of J f or f
  [[nodiscard]] double laplace_single(const Vector3& x, const Matrix& charges) const;
  [[nodiscard]] double laplace_single_normal(const Vector3& x, const Vector3& normal, const Matrix& charges) const;
  [[nodiscard]] double laplace_double(const Vector3& x, const Matrix& charges) const;
  [[nodiscard]] double laplace_double_normal(const Vector3& x, const Vector3& normal, const Matrix& charges) const;
  /// Stokes single layer at μ = 1 of J f and double layer of v. @param charges  [n_nodes x 3]
  [[nodiscard]] Vector3 stokes_single(const Vector3& x, const Matrix& charges) const;
  [[nodiscard]] Vector3 stokes_double(const Vector3& x, const Matrix& charges) const;

  /// The same sums for several targets as rows over the coefficients of the densities, see NearRows.
  /// @param points, normals  [n_targets x 3]
  /// @return                 [n_coefficients x PairColumns::count], of one target behind the other
  [[nodiscard]] Matrix rows(const Matrix& points, const Matrix& normals, const PairColumns& columns) const;

  /// D[1]: 0 outside, −1 inside, up to the error of the rule.
  [[nodiscard]] double enclosure(const Vector3& x) const;
  [[nodiscard]] Index n_nodes() const { return grid_.n_nodes(); }

 private:
  SphereTransform transform_;
  SmoothGrid grid_;
};

}  // namespace vehd
