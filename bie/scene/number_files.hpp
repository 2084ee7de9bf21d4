#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "bie/scene/scene.hpp"

/// Text files of numbers to which a scene refers: lines of numbers apart by blanks or a comma; # starts a comment.
namespace vehd {

/// Replaces every `path` of a waveform or of a property by place with the numbers of its file. A run so knows them even
/// when the file is gone.
/// @param folder  where a relative path starts
/// @throws InputError naming the line of the file
void read_number_files(Scene& scene, const std::filesystem::path& folder);

/// Times and values of a waveform; `name` stands for the file in messages. @throws InputError "file:line: …"
void read_waveform_rows(WaveformScene& waveform, std::istream& stream, const std::string& name);

}  // namespace vehd
