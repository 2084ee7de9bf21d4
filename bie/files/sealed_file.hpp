#pragma once

#include <filesystem>
#include <string>

/// Files that are verified completely before they are used: the content, then a line with its size and checksum. HDF5
/// ignores bytes after its own end, so its tools can read a sealed HDF5 file.
namespace vehd {

/// The content with its seal.
/// Accuracy: one flipped bit is always noticed, any other change with probability 1 − 2⁻³² (CRC-32)
std::string sealed(const std::string& content);

/// Content of a sealed file.
/// @throws InputError if the file is missing, truncated, altered or has no seal
std::string read_sealed_file(const std::filesystem::path& path);

}  // namespace vehd
