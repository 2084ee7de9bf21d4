#pragma once

#include <memory>

#include "bie/physics/effects/effect.hpp"
#include "bie/scene/scene.hpp"

namespace vehd::testing {

/// The scene rotated about the origin as a whole: shape, position, field, weight and flow.
/// @param rotation  about x if the scene has a Poiseuille flow, which is along x
Scene rotated_scene(Scene scene, const AxisAngle& rotation);

/// The scene with all vesicles shifted.
Scene shifted_scene(Scene scene, const Vector3& by);

/// A flow that adds this velocity everywhere.
std::shared_ptr<const ExplicitEffect> uniform_drift(const Vector3& velocity);

}  // namespace vehd::testing
