#pragma once

#include "bie/physics/effects/effect.hpp"

namespace vehd {

/// The field with the charging of the membrane.
EffectRow applied_field_row();
/// A current that the membrane pumps.
EffectRow pump_row();
/// Properties of the membrane that differ from place to place.
EffectRow spatial_variation_row();

}  // namespace vehd
