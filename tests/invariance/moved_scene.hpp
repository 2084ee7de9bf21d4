#pragma once

#include <memory>

#include "bie/physics/effects/effect.hpp"
#include "bie/scene/scene.hpp"

namespace vehd::testing {

/// The scene rotated about the origin as a whole: shape, place, field, weight and flow.
/// @param rotation  about x where the scene has a Poiseuille flow, which is along x
Scene rotated_scene(Scene scene, const AxisAngle& rotation);

/// All of its vesicles elsewhere.
Scene shifted_scene(Scene scene, const Vector3& by);

/// The same fluids moving past with this velocity everywhere.
std::shared_ptr<const ExplicitEffect> uniform_drift(const Vector3& velocity);

}  // namespace vehd::testing
