#pragma once

#include "bie/geometry/surface.hpp"

namespace vehd {

/// Largest less smallest distance of the grid points from the centroid: rounding on a sphere, wherever its points are.
double distance_variation(const Surface& surface);

}  // namespace vehd
