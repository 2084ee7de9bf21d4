#pragma once

#include "bie/physics/membrane.hpp"
#include "bie/stepping/fields.hpp"
#include "bie/stepping/frame.hpp"
#include "bie/stepping/state.hpp"

namespace vehd {

/// History quantities of a state, with its own axes for those of the laboratory. Extrema are those of the surface
/// between the nodes to third order in the spacing.
Diagnostics diagnose(const State& state, const Membrane& membrane, const Fields& fields);

/// The same quantities where the state is that of a frame: extents, inclination and the values at the north pole are
/// found anew along the axes of the laboratory.
/// @param fine  of all longitudes: an extreme of an axisymmetric surface lies on any of them
/// @param s     the surface on its grid
Diagnostics along_laboratory_axes(Diagnostics d, const Frame& frame, const SphereTransform& fine, const Surface& s,
                                  const State& state, const Fields& fields);

}  // namespace vehd
