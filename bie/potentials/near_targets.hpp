#pragma once

#include <vector>

#include "bie/potentials/near_rows.hpp"
#include "bie/potentials/smooth_grid.hpp"

namespace vehd {

/// A membrane and points outside it at which its layers are wanted.
struct PairGeometry {
  Matrix source;           ///< coefficients of the membrane, [n_coefficients x 3]
  Matrix points, normals;  ///< of the targets, [n_targets x 3]
  LayerFields fields;      ///< of the membrane, without densities
  SmoothGrid grid;         ///< from which nearest points are sought

  [[nodiscard]] Vector3 point(Index i) const { return points.row(i).transpose(); }
  [[nodiscard]] Vector3 normal(Index i) const { return normals.row(i).transpose(); }
};

/// What rules about the nearest points have to reach, see PairSettings.
struct NearRowSettings {
  double tolerance;
  int max_rules;
};

/// Rows over the coefficients of the densities at targets near a membrane, each by the graded rule about its nearest
/// point; targets of equal rules share tables.
/// @param targets  which of the points, in ascending order
/// @return         [n_coefficients x PairColumns::count], of one target behind the other
/// @throws ConvergenceError if the nearest point of a target is not found, if a target is not outside the membrane, or
/// if
///     the rules do not settle
/// Accuracy: the tolerance relative to the largest entry of each layer (tests/potentials/pair_layers_test.cpp)
/// Source: near_rows
Matrix rows_of_near_targets(const PairGeometry& at, const std::vector<Index>& targets, const PairColumns& columns,
                            const NearRowSettings& settings);

}  // namespace vehd
