#pragma once

#include <memory>

#include "meshes/block_map.hpp"
#include "meshes/relaxed_blocks.hpp"

namespace vehd::meshes {

/// The map of RelaxedBlocks: their polynomials P, corrected in the layers at γ and at the sphere on which these end by
/// the difference between P and the exact surface, linear in the distance across the layer; beyond that sphere,
/// straight lines to the outer one.
class RelaxedMap final : public BlockMap {
 public:
  /// @param blocks  of this shape with these axes
  /// @throws MeshError if the outer sphere does not enclose the shape
  RelaxedMap(const FrozenShape& shape, const BlockAxes& axes, double outer_radius,
             std::shared_ptr<const RelaxedBlocks> blocks);

  [[nodiscard]] Matrix3 derivative(const Block& block, const Point& reference) const override;

 private:
  /// Point outside the core, with ∂/∂s of its third coordinate, which is above 1 outside the relaxed layers.
  struct Place {
    BlockPlace place;
    double slope;
  };
  [[nodiscard]] Place place_of(const Block& block, const CubePoint& point) const;
  /// Fraction of the correction at γ, or at the sphere, that is added at a third coordinate, and its slope.
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
