#include "bie/files/sealed_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "bie/support/checksum.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

std::string seal_of(const std::string& content) {
  Checksum checksum;
  checksum.add(content);
  return fmt::format("\nvehd seal {:016x} {:08x}\n", content.size(), checksum.value());
}

}  // namespace

std::string sealed(const std::string& content) { return content + seal_of(content); }

std::string read_sealed_file(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(fmt::format("{}: {}", path.string(), problem));
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse("no such file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) refuse("cannot be read: " + error.message());
  // The seal is read first, because any other file may be of any size.
  std::string seal(seal_of({}).size(), '\0');
  const std::uintmax_t text_size = size - std::min<std::uintmax_t>(size, seal.size());
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(text_size));
  if (!stream.read(seal.data(), static_cast<std::streamsize>(seal.size())) || !seal.starts_with("\nvehd seal ")) {
    refuse("has no seal at its end: it is truncated, damaged or of another schema version");
  }
  std::string text(text_size, '\0');
  stream.seekg(0);
  if (!stream.read(text.data(), static_cast<std::streamsize>(text_size))) refuse("cannot be read");
  if (seal != seal_of(text)) refuse("is damaged: its bytes do not match their checksum");
  return text;
}

}  // namespace vehd
