#pragma once

#include "meshes/block_map.hpp"

namespace vehd::meshes {

/// A map along straight lines from the core to the membrane and on to the outer sphere:
///   core:   centre + K X/½
///   blend:  from centre + K v at s = ½ to x(r̂) at s = 1, linear in s
///   shell:  from x(r̂) at s = 1 to centre + R U g/|g| at s = 2, linear in s
/// K = U diag(half-widths) fits the core into the room that the shape leaves along each axis. Suited to shapes that are
/// little more than stretched spheres; a bowl folds the map.
class BlendedMap final : public BlockMap {
 public:
  /// @throws MeshError if the outer sphere does not enclose the shape
  BlendedMap(const FrozenShape& shape, const BlockAxes& axes, double outer_radius, double core_fraction);

  [[nodiscard]] Matrix3 derivative(const Block& block, const Point& reference) const override;

 private:
  [[nodiscard]] Point in_core(const Point& reference) const override;
  [[nodiscard]] Point around_core(const Block& block, const Point& reference, const Point& on_membrane) const override;

  Matrix3 core_;  // K
};

}  // namespace vehd::meshes
