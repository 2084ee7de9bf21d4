#pragma once

#include <string>
#include <vector>

#include "bie/scene/toml_values.hpp"

/// Tables [[vesicle]] of a scene file.
namespace vehd {

/// Names of the vesicles: those that are given, or their numbers from 0.
/// @param file  has such tables
/// @throws InputError "file:line: ..." where one has what it may not have, or lacks a shape
std::vector<std::string> read_vesicle_names(const TomlFile& file);

/// Makes of a file that of one of its vesicles: its own values take the place of those of all. A [vesicle.shape] with a
/// kind takes the place of [shape] as a whole. Every value keeps the line where it stands.
void take_vesicle(toml::table& file, std::size_t vesicle);

}  // namespace vehd
