#include "bie/files/sealed_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "bie/support/checksum.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Fifty times the size of a checkpoint of degree 64; anything larger is some other file.
constexpr std::uintmax_t largest_bytes = std::uintmax_t{1} << 26;

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
  if (error || size > largest_bytes) {
    refuse(fmt::format("{} bytes are too many; accepted: at most {}", size, largest_bytes));
  }
  std::string text(size, '\0');
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(text.data(), static_cast<std::streamsize>(size))) refuse("cannot be read");
  const std::size_t seal_size = seal_of({}).size();
  if (size < seal_size || text.find("\nvehd seal ", size - seal_size) != size - seal_size) {
    refuse("has no seal at its end: it is truncated, damaged or of another schema version");
  }
  const std::string seal = text.substr(size - seal_size);
  text.resize(size - seal_size);
  if (seal != seal_of(text)) refuse("is damaged: its bytes do not match their checksum");
  return text;
}

}  // namespace vehd
