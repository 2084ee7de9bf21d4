#pragma once

#include <toml++/toml.h>

#include <string>

#include "bie/scene/scene.hpp"

namespace vehd {

/// What [poration] needs of the other tables, and what does not go with it.
/// @param scene  of one vesicle
/// @param table  of its file @param file  its name in messages
/// @throws InputError
void check_poration(const Scene& scene, const toml::table& table, const std::string& file);

}  // namespace vehd
