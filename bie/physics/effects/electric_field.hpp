#pragma once

#include "bie/physics/effects/effect.hpp"

namespace vehd {

/// Registration of the applied field, with the charging of the membrane.
EffectRow applied_field_row();
/// Registration of the pump current.
EffectRow pump_row();
/// Registration of spatially varying properties of the membrane.
EffectRow spatial_variation_row();

}  // namespace vehd
