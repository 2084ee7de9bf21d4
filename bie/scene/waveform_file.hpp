#pragma once

#include <filesystem>
#include <istream>
#include <string>

#include "bie/scene/scene.hpp"

namespace vehd {

/// Replaces the path of a waveform, if it has one, with the times and values of the file: lines of two numbers apart by
/// blanks or a comma; # starts a comment. A run so knows its waveform even when the file is gone.
/// @param folder  where a relative path starts
/// @throws InputError "file:line: …"
void read_waveform_table(WaveformScene& waveform, const std::filesystem::path& folder);

/// The rows of such a file; `name` stands for it in messages. @throws InputError "file:line: …"
void read_waveform_rows(WaveformScene& waveform, std::istream& stream, const std::string& name);

}  // namespace vehd
