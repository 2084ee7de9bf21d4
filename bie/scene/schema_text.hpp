#pragma once

#include <string>
#include <vector>

/// The reference of the scene format, made from the key table.
namespace vehd {

/// One row of the key table as texts.
struct KeyReference {
  std::string table, name, kinds, symbol, type, unit, range, default_value, meaning;
};

/// Every row, in the order of the key table.
std::vector<KeyReference> key_references();

/// Reference for a terminal: one block of aligned columns for each table.
std::string scene_help();

/// The keys of scenes as a Markdown page, docs/scene_keys.md.
std::string scene_help_markdown();

}  // namespace vehd
