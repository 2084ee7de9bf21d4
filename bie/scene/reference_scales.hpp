#pragma once

#include <toml++/toml.h>

#include <string>

#include "bie/scene/scene.hpp"

namespace vehd {

/// Fills the scales that [units] leaves out from values of the scene that are given in SI units, so that the vesicle's
/// radius √(area/4π), the viscosity, the shortest time (reference_time.hpp) and the membrane capacitance are 1, each
/// where it is the one to fix a scale. A scale without such a value stays absent.
/// @param file  the whole scene file
/// @param name  of the file
/// @throws InputError if such a value cannot be read
void derive_reference_scales(UnitsScene& units, const toml::table& file, const std::string& name);

/// What could have a unit to give a scale of [units], as it stands in messages: "area" in [shape].
std::string source_of_scale(std::string_view scale);

}  // namespace vehd
