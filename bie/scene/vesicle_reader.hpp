#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

/// Tables [[vesicle]] of a scene file.
namespace vehd {

/// Whether the file has any.
bool has_vesicles(const toml::table& file);

/// Names of the vesicles: those that are given, or their numbers from 0.
/// @throws InputError "file:line: ..." where a table [[vesicle]] has what it may not have, or lacks a shape
std::vector<std::string> read_vesicle_names(const toml::table& file, const std::string& name);

/// Makes of a file that of one of its vesicles: its own values take the place of those of all. A [vesicle.shape] with a
/// kind takes the place of [shape] as a whole. Every value keeps the line where it stands.
void take_vesicle(toml::table& file, std::size_t vesicle);

}  // namespace vehd
