#include "bie/scene/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bie/scene/units.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd {
namespace {

/// Texts for a type of values.
struct TypeWords {
  std::string_view name;
  std::string_view accepted;  ///< {} stands for the range, the words or the units of the key
};
constexpr std::array<TypeWords, 12> type_words = {{
    {"boolean", "true or false"},
    {"integer", "an integer, {}"},
    {"number", "a number {}"},
    {"text", "a text in quotes"},
    {"3 numbers", "3 numbers [x, y, z], each {}"},
    {"3 x 3 numbers", "3 rows of 3 finite numbers"},
    {"4 numbers", "4 finite numbers [axis_x, axis_y, axis_z, degrees]"},
    {"list of numbers", "a list of numbers, each {}"},
    {"list of {n, m, a}", "entries {{n = degree, m = -n ... n, a = finite number}}"},
    {"list of {from, to, every}", "entries {{from = time, to = time, every = time}}, each {}"},
    {"word", "{}"},
    {"text with unit", "a positive number with its unit in quotes, {}"},
}};

const TypeWords& words_of(ValueType type) { return type_words.at(static_cast<std::size_t>(type)); }

/// A value in one line of TOML.
struct TomlText {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const {
    const std::string text = fmt::format("{}", value);
    return text.find_first_of(".einf") == std::string::npos ? text + ".0" : text;
  }
  std::string operator()(const std::string& value) const {
    std::string quoted = "\"";
    for (const char letter : value) {
      if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) {
        quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(letter));
        continue;
      }
      if (letter == '"' || letter == '\\') quoted += '\\';
      quoted += letter;
    }
    return quoted + '"';
  }
  std::string operator()(const HarmonicMode& mode) const {
    return fmt::format("{{n = {}, m = {}, a = {}}}", mode.n, mode.m, (*this)(mode.a));
  }
  std::string operator()(const OutputWindow& window) const {
    return fmt::format("{{from = {}, to = {}, every = {}}}", (*this)(window.from), (*this)(window.to),
                       (*this)(window.every));
  }
  template <typename Entry, std::size_t size>
  std::string operator()(const std::array<Entry, size>& entries) const {
    return list(entries);
  }
  template <typename Entry>
  std::string operator()(const std::vector<Entry>& entries) const {
    return list(entries);
  }

 private:
  template <typename Entries>
  [[nodiscard]] std::string list(const Entries& entries) const {
    std::vector<std::string> parts;
    for (const auto& entry : entries) parts.push_back((*this)(entry));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
};

}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && value <= upper && (lower_excluded ? value > lower : value >= lower);
}

std::string Range::text() const {
  if (std::isinf(lower) && std::isinf(upper)) return "any finite number";
  if (std::isinf(upper)) return fmt::format("{} {}", lower_excluded ? ">" : ">=", lower);
  if (lower_excluded) return fmt::format("> {} and <= {}", lower, upper);
  return fmt::format("{} ... {}", lower, upper);
}

bool KeyDescription::is_called(std::string_view word) const {
  return !word.empty() && (word == name || word == other_name);
}

bool KeyDescription::accepts(double value) const {
  const double magnitude = unit == "time" ? std::min(std::abs(value), 1.0) : value;
  return range.contains(value) && has_magnitude_in_range(magnitude);
}

bool KeyDescription::is_for(std::string_view kind) const {
  return kinds.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

std::string_view KeyDescription::type_text() const { return words_of(type).name; }

std::string KeyDescription::accepted_text() const {
  std::string detail = range.text();
  if (type == ValueType::number && detail == Range{}.text()) return detail;
  if (type == ValueType::word) detail = fmt::format("{}", fmt::join(words, ", "));
  if (type == ValueType::quantity) detail = find_dimension(unit)->accepted();
  return fmt::format(fmt::runtime(words_of(type).accepted), detail);
}

std::vector<std::string_view> key_names(std::string_view table) {
  std::vector<std::string_view> names;
  for (const KeyDescription& key : scene_keys()) {
    if (key.table == table && std::ranges::find(names, key.name) == names.end()) names.push_back(key.name);
  }
  return names;
}

const TableDescription* find_table(std::string_view name) {
  const auto found = std::ranges::find(scene_tables(), name, &TableDescription::name);
  return found == scene_tables().end() ? nullptr : &*found;
}

std::vector<std::string_view> tables_with(std::string_view key) {
  std::vector<std::string_view> names;
  for (const TableDescription& table : scene_tables()) {
    if (find_key(table.name, key) != nullptr) names.push_back(table.name);
  }
  return names;
}

const KeyDescription* find_key(std::string_view table, std::string_view name) {
  for (const KeyDescription& key : scene_keys()) {
    if (key.table == table && key.is_called(name)) return &key;
  }
  return nullptr;
}

const KeyDescription* find_key_of_kind(std::string_view table, std::string_view name, std::string_view kind) {
  for (const KeyDescription& key : scene_keys()) {
    if (key.table == table && key.is_called(name) && key.is_for(kind)) return &key;
  }
  return nullptr;
}

const KeyDescription* kind_key(std::string_view table) {
  const KeyDescription* kind = find_key(table, "kind");
  return kind != nullptr ? kind : find_key(table, "model");
}

std::string kind_of(const Scene& scene, std::string_view table) {
  const KeyDescription* kind = kind_key(table);
  return kind == nullptr ? std::string() : std::get<std::string>(*kind->get(scene));
}

bool applies(const KeyDescription& key, const Scene& scene) {
  return find_table(key.table)->present(scene) && key.is_for(kind_of(scene, key.table));
}

std::optional<Value> default_value(const KeyDescription& key) {
  Scene scene;
  find_table(key.table)->create(scene);
  return key.get(scene);
}

bool has_default_in_units(const KeyDescription& key) {
  if (key.required || find_dimension(key.unit) == nullptr) return false;
  const auto value = default_value(key);
  const double* number = value ? std::get_if<double>(&*value) : nullptr;
  return number != nullptr && *number != 0.0;
}

bool needs_value(const KeyDescription& key, const Scene& scene) {
  if (key.required) return true;
  return scene.units && has_default_in_units(key) && (!key.default_has_effect || key.default_has_effect(scene));
}

std::vector<std::string> differing_keys(const Scene& a, const Scene& b) {
  if (vesicle_names(a) != vesicle_names(b)) return {"vesicle.name"};
  const bool several = !a.vesicles.empty();
  std::vector<std::string> names;
  const auto compare = [&](const Scene& one, const Scene& other, const std::string& prefix, bool of_vesicle) {
    for (const KeyDescription& key : scene_keys()) {
      if (several && is_of_vesicle(key) != of_vesicle) continue;
      const auto value = applies(key, one) ? key.get(one) : std::nullopt;
      const auto other_value = applies(key, other) ? key.get(other) : std::nullopt;
      const std::string name = fmt::format("{}{}.{}", prefix, key.table, key.name);
      if (value != other_value && std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  };
  compare(a, b, "", false);
  for (std::size_t v = 0; v < a.vesicles.size(); ++v) {
    compare(alone(a, v), alone(b, v), fmt::format("vesicle[{}].", v), true);
  }
  return names;
}

std::string to_toml(const Value& value) { return std::visit(TomlText{}, value); }

std::string to_toml(const KeyDescription& key, const Value& value) {
  if (key.type != ValueType::quantity) return to_toml(value);
  return TomlText{}(fmt::format("{} {}", std::get<double>(value), find_dimension(key.unit)->si_unit()));
}

}  // namespace vehd
