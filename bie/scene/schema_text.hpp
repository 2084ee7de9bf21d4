#pragma once

#include <string>

/// The reference of the scene format, made from the key table.
namespace vehd {

/// For a terminal: one block of aligned columns for each table.
std::string scene_help();

/// The same as a Markdown page, docs/scene_keys.md.
std::string scene_help_markdown();

}  // namespace vehd
