#pragma once

#include <toml++/toml.h>

#include <string>

#include "bie/scene/scene.hpp"

namespace vehd {

/// What properties by place and a pump need of the other tables, and what does not go with them.
/// @param scene  of one vesicle
/// @param table  of its file @param file  its name in messages
/// @throws InputError
void check_places(const Scene& scene, const toml::table& table, const std::string& file);

}  // namespace vehd
