#pragma once

#include "bie/physics/effects/effect.hpp"

namespace vehd {

/// Images of the membranes in Model::wall.
EffectRow wall_row();

}  // namespace vehd
