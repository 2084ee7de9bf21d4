#pragma once

#include <string>

#include "bie/scene/toml_values.hpp"

namespace vehd {

/// Fills the scales that [units] leaves out from values of the scene that are given in SI units, so that the vesicle's
/// radius √(area/4π), the viscosity, the shortest time and the membrane capacitance are 1, each where it is the one to
/// fix a scale. A scale without such a value stays absent. The shortest time is what is fastest in the scene: a pulse,
/// the period of a waveform, the time of a rate of flow, and, with the reference length L and viscosity μ, the charging
/// time L C_m (1/σ_i + 1/(2σ_e)), the electric time μ/(ε E²) and the bending time μ L³/κ_B.
/// @param file  the whole scene file
/// @throws InputError where such a value is to be refused as it stands: other keys would be blamed for a scale that it
/// does not give
void derive_reference_scales(UnitsScene& units, const TomlFile& file);

/// What could have a unit to give a scale of [units], as it stands in messages: "area" in [shape].
std::string source_of_scale(std::string_view scale);

}  // namespace vehd
