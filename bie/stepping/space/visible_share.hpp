#pragma once

#include "bie/sphere/transform.hpp"
#include "bie/stepping/state/surface_fields.hpp"

namespace vehd {

/// Which share of what the degrees of a membrane could do at most, by the bounds of Resolution, can be seen: 1 where
/// nothing is known.
struct VisibleShare {
  double shape = 1.0;
  double potential = 1.0;  ///< of V_m
};

/// Of the upper half of the degrees, n > p/2. Their part x_h of x moves the surface by n·x_h; the rest moves points
/// along it, which no one sees. Their part of V_m changes it at a fixed place by V_h − ∇_γV_m·x_h. The largest of
/// either at the nodes over the sum of the bounds is the share; 1 where there are no such degrees.
/// @param fine  transform between the degree of the membrane and a grid
/// Accuracy: exact for the formulas (tests/stepping/space/visible_share_test.cpp)
VisibleShare visible_share(const SphereTransform& fine, const SurfaceFields& membrane);

}  // namespace vehd
