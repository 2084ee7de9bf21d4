#pragma once

#include "bie/physics/effects/membrane_material.hpp"
#include "bie/physics/unknowns.hpp"

namespace vehd {

/// The unknowns of one membrane with what else rides on its material points, in spherical-harmonic coefficients of one
/// degree, index n² + n + m (docs/conventions.md). Fields of absent effects are empty.
struct SurfaceFields : Unknowns {
  Vector area_strain{};         ///< W/W_ref − 1
  Vector tension{};             ///< λ, also the initial guess of the next solve; empty unless inextensible
  MembraneMaterial material{};  ///< what differs from place to place
};

}  // namespace vehd
