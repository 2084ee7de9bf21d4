#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Properties of a membrane that differ from place to place and ride on its material points: coefficients of a degree,
/// or values on a grid. An empty one is the same everywhere, as the parameters of the membrane say.
struct MembraneMaterial {
  Vector capacitance;            ///< C_m
  Vector conductance;            ///< G_m
  Vector pump_current;           ///< J_p, per area and outwards, where the waveform of the pump is 1; empty: no pump
  Vector bending_modulus;        ///< κ_B; there together with the next
  Vector spontaneous_curvature;  ///< c
};

/// Those that are there, one after the other: visit(Vector&).
template <typename Material, typename Visit>
void for_each_property(Material& material, const Visit& visit) {
  for (auto* property : {&material.capacitance, &material.conductance, &material.pump_current,
                         &material.bending_modulus, &material.spontaneous_curvature}) {
    if (property->size() > 0) visit(*property);
  }
}

}  // namespace vehd
