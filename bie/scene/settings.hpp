#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vehd {

/// Source of a scene: a file or a text, and values that replace some of its own.
struct SceneSource {
  std::filesystem::path file;  ///< paths in file and text are relative to its folder
  std::vector<std::string>
      settings;  ///< "table.key=value", as for the option --set; the later one counts if a key is set twice
  std::optional<std::string> text{};  ///< replaces the content of the file, which need not exist
};

/// Sets values in the tables of a scene file. A value that is not TOML is a text, so that words need no quotes in a
/// shell: flow.kind=shear, flow.rate=2 1/s. Messages about a value name its option instead of a line.
/// @param settings  "table.key=value", or "vesicle.NAME.table.key=value" for one of several vesicles
/// @throws InputError if one of them is not of that form; values are checked with the rest of the scene
void apply_settings(toml::table& file, const std::vector<std::string>& settings);

/// "table.key" for "vesicle.NAME.table.key" with one of these names; other keys unchanged.
std::string key_of_vesicle(const std::string& key, const std::vector<std::string>& names);

/// Moves the values of `from` into `to`, where they replace others. They are moved because the copy of a node loses its
/// place in the file.
void merge_tables(toml::table& to, toml::table&& from);

/// Whether a node comes from a setting. The path of its source is then the option as given.
bool is_from_setting(const toml::node& node);

}  // namespace vehd
