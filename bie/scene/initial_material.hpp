#pragma once

#include "bie/physics/membrane_material.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// Factor of a property over the parameter sphere, coefficients.
/// @param order  that a cap is cut to
/// Accuracy: harmonics exact, a cap to its truncation, see place_truncation
Vector place_factor(const PlaceScene& places, int order);

/// Largest error of a cap that is cut to a degree, over the difference of its two factors; 0 of harmonics.
double place_truncation(const PlaceScene& places, int order);

/// What differs from place to place on the membrane of a scene of one vesicle at time 0, turned with the shape:
/// coefficients of the scene's degree.
MembraneMaterial initial_material(const Scene& scene);

}  // namespace vehd
