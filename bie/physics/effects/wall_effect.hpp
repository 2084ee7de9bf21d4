#pragma once

#include "bie/physics/effects/effect.hpp"

namespace vehd {

/// Registration of Model::wall, in which the membranes have images.
EffectRow wall_row();

}  // namespace vehd
