#pragma once

#include <map>
#include <utility>

#include "bie/sphere/transform.hpp"

namespace vehd {

/// Transforms to the grids of smooth rules, which membranes of one degree have in common: their tables take longer to
/// make than to use. Not thread safe.
class SharedTransforms {
 public:
  /// Makes it where it is missing.
  /// @param order       degree of the coefficients
  /// @param grid_order  of the grid, not below it
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

}  // namespace vehd
