#include "bie/files/seal.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <sstream>
#include <vector>

#include "bie/support/checksum.hpp"

namespace vehd {
namespace {

/// Objects of a seal. An invalid line counts as an object whose path no file has.
ObjectChecksums sealed_objects(const std::string& seal) {
  ObjectChecksums objects;
  std::istringstream lines(seal);
  for (std::string line; std::getline(lines, line);) {
    std::uint32_t checksum = 0;
    const char* end = line.data() + line.size();
    const auto [rest, error] = std::from_chars(line.data(), end, checksum, 16);
    const bool is_line = error == std::errc() && rest + 1 < end && *rest == ' ';
    objects.emplace(is_line ? std::string(rest + 1, end) : "an object of a damaged seal", checksum);
  }
  return objects;
}

}  // namespace

std::uint32_t content_checksum(ContentKind kind, std::span<const hsize_t> extents, std::string_view bytes) {
  Checksum checksum;
  const char letter = static_cast<char>(kind);
  checksum.add(std::string_view(&letter, 1));
  for (const hsize_t extent : extents) checksum.add(static_cast<std::int64_t>(extent));
  checksum.add(bytes);
  return static_cast<std::uint32_t>(checksum.value());
}

std::uint32_t attribute_checksum(std::string_view name, ContentKind kind, std::string_view bytes) {
  Checksum checksum;
  checksum.add(name);
  const char between[] = {'=', static_cast<char>(kind)};
  checksum.add(std::string_view(between, sizeof between));
  checksum.add(bytes);
  return static_cast<std::uint32_t>(checksum.value());
}

std::string seal_path(const std::string& group) { return group == "/" ? "/seal" : group + "/seal"; }

std::string seal_text(const ObjectChecksums& objects) {
  std::string text;
  for (const auto& [path, checksum] : objects) text += fmt::format("{:08x} {}\n", checksum, path);
  return text;
}

std::int64_t seal_checksum(const std::string& seal) {
  Checksum checksum;
  checksum.add(seal);
  return checksum.value();
}

std::string differences(const std::string& seal, const ObjectChecksums& objects) {
  // The first few are enough: in a file that was mixed up, everything differs.
  constexpr std::size_t most_named = 3;
  const ObjectChecksums sealed = sealed_objects(seal);
  std::vector<std::string> found;
  for (const auto& [path, checksum] : sealed) {
    const auto object = objects.find(path);
    if (object == objects.end()) {
      found.push_back(path + " is missing");
    } else if (object->second != checksum) {
      found.push_back(path + " does not match its checksum");
    }
  }
  for (const auto& [path, checksum] : objects) {
    if (!sealed.contains(path)) found.push_back(path + " was added");
  }
  if (found.size() > most_named) {
    const std::string others = fmt::format("{} more differ", found.size() - most_named);
    found.resize(most_named);
    found.push_back(others);
  }
  return fmt::format("{}", fmt::join(found, ", "));
}

}  // namespace vehd
