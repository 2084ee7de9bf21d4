#include "bie/scene/toml_file.hpp"

#include <fmt/format.h>

#include <cctype>
#include <fstream>
#include <sstream>

#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// No sensible file comes near this; what does is some other file.
constexpr std::uintmax_t largest_bytes = 1 << 20;

/// The parser limits nested values but builds a table for every part of a dotted key, whose destruction recurses.
/// @throws InputError at the first key with too many parts
void require_short_keys(const std::string& text, const std::string& name) {
  constexpr int most_parts = 16;
  int line = 1;
  int dots = 0;
  char quote = '\0';
  for (const char letter : text) {
    if (letter == '\n') {
      ++line;
      dots = 0;
      quote = '\0';
    } else if (quote != '\0') {
      if (letter == quote) quote = '\0';
    } else if (letter == '"' || letter == '\'') {
      quote = letter;
    } else if (letter == '.') {
      if (++dots >= most_parts) {
        throw InputError(fmt::format("{}:{}: a key of too many parts; accepted: at most {}", name, line, most_parts));
      }
    } else if (std::isalnum(static_cast<unsigned char>(letter)) == 0 && letter != '_' && letter != '-' &&
               letter != ' ' && letter != '\t') {
      dots = 0;
    }
  }
}

}  // namespace

std::string text_of_toml_file(const std::filesystem::path& path, std::string_view what) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(fmt::format("{}: no such file", path.string()));
  if (!std::filesystem::is_regular_file(path, error)) {
    throw InputError(fmt::format("{}: not a file; {} (TOML) is expected", path.string(), what));
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (size > largest_bytes) {
    throw InputError(fmt::format("{}: {} bytes are too many for {}; accepted: at most {}", path.string(), size, what,
                                 largest_bytes));
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw InputError(fmt::format("{}: cannot be read", path.string()));
  return text.str();
}

toml::table parse_toml(const std::string& text, const std::string& name) {
  require_short_keys(text, name);
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", name, error.source().begin.line, error.description()));
  }
}

}  // namespace vehd
