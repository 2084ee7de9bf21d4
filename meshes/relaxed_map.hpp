#pragma once

#include <memory>

#include "meshes/block_map.hpp"
#include "meshes/relaxed_blocks.hpp"

namespace vehd::meshes {

/// The map of RelaxedBlocks: their polynomials P, and in the layers at γ and at the sphere that they end on what these
/// lack of x(r̂) and of the sphere, linear in the distance across the layer; beyond that sphere straight lines to the
/// outer one.
class RelaxedMap final : public BlockMap {
 public:
  /// @param blocks  of this shape with these axes
  /// @throws MeshError if the outer sphere does not hold the shape
  RelaxedMap(const FrozenShape& shape, const BlockAxes& axes, double outer_radius,
             std::shared_ptr<const RelaxedBlocks> blocks);

  [[nodiscard]] Matrix3 derivative(const Block& block, const Point& reference) const override;

 private:
  /// Coordinates of a point outside the core, with ∂/∂X of the third; a third beyond 1 lies outside the relaxed layers.
  struct Place {
    BlockPlace place;
    double slope;
  };
  [[nodiscard]] Place place_of(const Block& block, const CubePoint& point) const;
  /// Share of what P lacks at γ, or at the sphere, that is added at a third coordinate, with its slope.
  struct Share {
    double value, slope;
  };
  [[nodiscard]] Share share_of_membrane(Region region, double t) const;
  [[nodiscard]] Share share_of_end(Region region, double t) const;
  [[nodiscard]] Point in_core(const Point& reference) const override;
  [[nodiscard]] Point around_core(const Block& block, const Point& reference, const Point& on_membrane) const override;

  std::shared_ptr<const RelaxedBlocks> blocks_;
};

}  // namespace vehd::meshes
