#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace vehd {

/// Text of a TOML file that somebody has written.
/// @param what  it is, for messages: "a scene file"
/// @throws InputError if it is missing, no file or far too long
std::string text_of_toml_file(const std::filesystem::path& path, std::string_view what);

/// @param name  stands for the file in messages
/// @throws InputError "name:line: ..."
toml::table parse_toml(const std::string& text, const std::string& name);

}  // namespace vehd
