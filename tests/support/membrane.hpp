#pragma once

#include <numbers>

#include "bie/physics/membrane.hpp"
#include "tests/support/layers.hpp"

namespace vehd::testing {

/// A frozen membrane on the tables of `space`, which must outlive it.
inline Membrane make_membrane(const Space& space, const Matrix& position, const LayerSelection& selection) {
  Surface surface = make_surface(space.fine, position);
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  return {space.fine, std::move(surface), assemble(space, position, selection), radius};
}

}  // namespace vehd::testing
