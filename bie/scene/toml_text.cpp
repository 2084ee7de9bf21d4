#include "bie/scene/toml_text.hpp"

#include <fmt/format.h>

#include "bie/scene/units.hpp"

namespace vehd {
namespace {

std::string number_to_toml(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".einf") == std::string::npos) text += ".0";
  return text;
}

std::string text_to_toml(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      quoted += '\\';
      quoted += letter;
    } else if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(letter));
    } else {
      quoted += letter;
    }
  }
  return quoted + '"';
}

template <typename Numbers>
std::string numbers_to_toml(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + number_to_toml(number);
  return "[" + text + "]";
}

struct TomlText {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return number_to_toml(value); }
  std::string operator()(const std::string& value) const { return text_to_toml(value); }
  std::string operator()(const Triple& value) const { return numbers_to_toml(value); }
  std::string operator()(const AxisAngle& value) const { return numbers_to_toml(value); }
  std::string operator()(const std::vector<double>& value) const { return numbers_to_toml(value); }
  std::string operator()(const TripleOfTriples& rows) const {
    return fmt::format("[{}, {}, {}]", numbers_to_toml(rows[0]), numbers_to_toml(rows[1]), numbers_to_toml(rows[2]));
  }
  std::string operator()(const std::vector<HarmonicMode>& modes) const {
    std::string text;
    for (const HarmonicMode& mode : modes) {
      text +=
          fmt::format("{}{{n = {}, m = {}, a = {}}}", text.empty() ? "" : ", ", mode.n, mode.m, number_to_toml(mode.a));
    }
    return "[" + text + "]";
  }
  std::string operator()(const std::vector<OutputWindow>& windows) const {
    std::string text;
    for (const OutputWindow& window : windows) {
      text += fmt::format("{}{{from = {}, to = {}, every = {}}}", text.empty() ? "" : ", ", number_to_toml(window.from),
                          number_to_toml(window.to), number_to_toml(window.every));
    }
    return "[" + text + "]";
  }
};

}  // namespace

std::string to_toml(const Value& value) { return std::visit(TomlText{}, value); }

std::string to_toml(const KeyDescription& key, const Value& value) {
  if (key.type != ValueType::quantity) return to_toml(value);
  return text_to_toml(fmt::format("{} {}", std::get<double>(value), find_dimension(key.unit)->si_unit()));
}

}  // namespace vehd
