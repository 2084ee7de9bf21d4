#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string>

#include "bie/scene/sweep_file.hpp"

namespace vehd {

/// One key of [vary]: `{values = [...]}` or `{from, to, count, scale}`.
/// @param table  what the key is given
/// @param units  of the base scene
/// @throws InputError if the scene has no such key, or if the key does not accept one of the values
VariedKey varied_key(const std::string& name, const toml::table& table, const std::string& file,
                     const std::optional<UnitsScene>& units);

}  // namespace vehd
