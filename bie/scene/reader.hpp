#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bie/scene/scene.hpp"
#include "bie/scene/settings.hpp"

namespace vehd {

class RunReader;

/// Reads and validates a scene file (TOML, docs/scenes).
/// @throws InputError "file:line: what is wrong, the value, what is accepted"
Scene read_scene(const std::filesystem::path& path);

/// Reads a scene with other values for some keys. Messages about such a value name its setting instead of "file:line".
Scene read_scene(const SceneSource& source);

/// Reads a scene from text in memory.
/// @param name    stands for the file in messages
/// @param folder  where relative paths in the scene start
/// @param settings  values that replace those in the text, see SceneSource
Scene parse_scene(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                  const std::vector<std::string>& settings = {});

/// The table [units] of the text of an effective scene, in which all its scales are spelled out.
/// @return nullopt if the text has no such table
/// @throws InputError "name:line: ..."
std::optional<UnitsScene> parse_units(const std::string& text, const std::string& name);

/// Reference scales of a run; nullopt if its scene has no [units]. @throws InputError
std::optional<UnitsScene> units_of(const RunReader& run);

}  // namespace vehd
