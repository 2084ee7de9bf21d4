#pragma once

#include "bie/physics/model.hpp"
#include "bie/sphere/reflection.hpp"
#include "bie/stepping/state/surface_fields.hpp"

/// What is its own image; deviations within 1e-12 of the size count as rounding.
namespace vehd {

/// Sign that V_m takes under the reflection g: that of g E = ± E. 0 where the field has another image, or the flow or
/// any other effect.
int potential_sign(const Model& model, const Reflection& g);

/// Are field, flow and all effects their own images under every rotation about z?
bool is_invariant_under_rotations(const Model& model);

/// Are place, shape, strain, V_m and material of both membranes the same? Lengths are compared with the size of the
/// second one.
bool are_same(const SurfaceFields& image, const SurfaceFields& fields);

}  // namespace vehd
