#pragma once

#include <toml++/toml.h>

#include <string>

#include "bie/scene/scene.hpp"

namespace vehd {

/// Conditions that tie the vesicles of a scene together: each is outside all others, and what is solved for all of them
/// at once is possible.
/// @param file  with its tables [[vesicle]]
/// @param name  stands for the file in messages
/// @throws InputError "file:line: ..." at the vesicle to blame
void check_vesicles(const Scene& scene, const toml::table& file, const std::string& name);

}  // namespace vehd
