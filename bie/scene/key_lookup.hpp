#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bie/scene/scene.hpp"
#include "bie/scene/schema.hpp"
#include "bie/scene/settings.hpp"

/// Single keys of a scene by their full name, "table.key".
namespace vehd {

/// Value of a key as TOML; empty if the scene has none.
std::string key_text(const Scene& scene, const std::string& name);
/// Dimension of its numbers, as "length/time"; "1" or empty if they have none.
std::string_view key_dimension(const Scene& scene, const std::string& name);

/// All rows of a key; different kinds of its table may have different rows.
/// @param where  table at `place` that has the name, for messages: "[vary]"
/// @throws InputError "place: ..." with the nearest name if scenes have no such key
std::vector<const KeyDescription*> keys_named(const std::string& name, const std::string& place,
                                              std::string_view where);

/// Whether a scene file has a key or table. @throws InputError if the file cannot be read
bool is_given(const SceneSource& source, const std::string& name);

/// "file:line" of a key in a valid scene file: of its table if the key is left out, of the first line if the table is
/// left out too; the option --set if that gives the key. @throws InputError if the file can no longer be read
std::string key_place(const SceneSource& source, const std::string& name);

}  // namespace vehd
