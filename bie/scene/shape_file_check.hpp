#pragma once

#include <toml++/toml.h>

#include <string>

#include "bie/scene/scene.hpp"

namespace vehd {

/// Checks that a scene can start from its shape file, if it has one, and lets it start with the file's V_m where there
/// is one and the scene does not say otherwise. A scale that the file or the scene alone has is an error where a value
/// needs it: the length of the shape, unless [shape] sets its area, the time of a snapshot, and the potential.
/// @param table  the parsed scene, for the lines of its keys
/// @throws InputError "file:line: ..." at the key to blame
void check_shape_file(Scene& scene, const toml::table& table, const std::string& file);

}  // namespace vehd
