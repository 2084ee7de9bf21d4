#pragma once

#include <map>
#include <utility>

#include "bie/potentials/layer_sums.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Transforms to the grids of smooth rules, shared by membranes of one degree: their tables take longer to make than to
/// use. Not thread safe.
class SharedTransforms {
 public:
  /// The transform, made on first use.
  /// @param order       degree of the coefficients
  /// @param grid_order  of the grid, not below `order`
  const SphereTransform& of(int order, int grid_order) {
    auto found = made_.find({order, grid_order});
    if (found == made_.end()) {
      const SphereGrid grid = make_grid(grid_order, fast_longitudes(2 * grid_order + 2));
      found = made_.emplace(std::pair(order, grid_order), SphereTransform(order, grid)).first;
    }
    return found->second;
  }

 private:
  std::map<std::pair<int, int>, SphereTransform> made_;
};

/// Upsampled grid: the quadrature of far targets and the start of the search for the nearest point.
struct SmoothGrid {
  Matrix nodes;         ///< [n_nodes x columns], see NodeColumns
  Vector weight;        ///< [n_nodes]
  Matrix directions;    ///< [n_nodes x 3], on the unit sphere
  Matrix area_vectors;  ///< J n, [n_nodes x 3]
  Vector spacing;       ///< [n_nodes], largest distance to a neighbour, to first order

  [[nodiscard]] Index n_nodes() const { return nodes.rows(); }
};

/// The fields on the grid of order grid_order, with their quadrature.
/// Source: paper Eq. (22)
SmoothGrid make_smooth_grid(const LayerFields& fields, int grid_order);
/// The fields on the grid of a transform of their degree.
SmoothGrid make_smooth_grid(const LayerFields& fields, const SphereTransform& transform);

/// Sums of the smooth rule: error about exp(−2π distance/spacing).
/// @param target  off the surface, in the coordinates of the grid
/// Source: paper Eq. (22); error of the trapezoidal rule near a singularity: Trefethen and Weideman 2014
LayersAt smooth_sums(const SmoothGrid& grid, const NodeColumns& columns, const Vector3& target);

/// √(area/4π).
double mean_radius(const SmoothGrid& grid);

/// Nodes from which the nearest point of the membrane is searched: the nearest one and, if less than a spacing farther,
/// the nearest one whose normal points the other way. Where two parts of the membrane are closer than their nodes, the
/// nearest node may belong to the farther part.
/// Distances are from node to target.
struct NearestNodes {
  Index first = 0, opposite = 0;
  bool opposite_counts = false;
  double distance = 0.0;  ///< of the first
};

/// The nearest nodes of a target.
NearestNodes nearest_nodes(const SmoothGrid& grid, const Vector3& target);

/// Least weighted |x − y|² between each target x and the nodes y of a grid.
/// @param weights  of the nodes, [n_nodes]
/// @param x        [n_targets x 3]
/// @return         [n_targets]
Vector least_weighted_squares(const SmoothGrid& grid, const Vector& weights, const Matrix& x);

}  // namespace vehd
