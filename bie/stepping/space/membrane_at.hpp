#pragma once

#include "bie/physics/membrane.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/support/instruments.hpp"

namespace vehd {

/// The membrane at a position with the operators of the selection; it may outlive the space. A viscosity contrast takes
/// the place of the double layer that it is made of.
Membrane membrane_at(const MembraneSpace& space, const Matrix& position, const LayerSelection& selection,
                     double viscosity_ratio, Instruments& instruments);

/// What differs from place to place, as a Membrane has it.
/// @param coefficients  of the degree of the space
MembraneMaterial material_at(const MembraneSpace& space, const MembraneMaterial& coefficients);

}  // namespace vehd
