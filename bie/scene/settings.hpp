#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vehd {

/// Where a scene comes from: a file or a text, and values that take the place of its own.
struct SceneSource {
  std::filesystem::path file;  ///< paths in either are relative to its folder
  std::vector<std::string>
      settings;  ///< "table.key=value", as of the option --set; of two for one key the later counts
  std::optional<std::string> text{};  ///< in place of what the file holds, which need not exist
};

/// Puts values into the tables of a scene file. A value is TOML; what is no TOML is a text, so that a shell's words
/// need no quotes of their own: flow.kind=shear, flow.rate=2 1/s. Messages about a value name its option in place of a
/// line.
/// @param settings  "table.key=value", or "vesicle.NAME.table.key=value" of one of several vesicles
/// @throws InputError if one of them is not of that form; what it says is checked with the rest of the scene
void apply_settings(toml::table& file, const std::vector<std::string>& settings);

/// "table.key" of "vesicle.NAME.table.key" with one of these names; any other key as it is.
std::string key_of_vesicle(const std::string& key, const std::vector<std::string>& names);

/// Moves what `from` has into `to`, where its values take the place of others: a node that is copied forgets where it
/// was written.
void merge_tables(toml::table& to, toml::table&& from);

/// Whether a node comes from a setting. Its path is then the option as it was given.
bool is_from_setting(const toml::node& node);

}  // namespace vehd
