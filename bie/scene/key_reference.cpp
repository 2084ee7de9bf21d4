#include "bie/scene/key_reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bie/scene/schema.hpp"
#include "bie/scene/toml_text.hpp"

namespace vehd {
namespace {

std::string type_text(const KeyDescription& key) {
  switch (key.type) {
    case ValueType::boolean:
      return "boolean";
    case ValueType::integer:
      return "integer";
    case ValueType::number:
      return "number";
    case ValueType::word:
      return "word";
    case ValueType::text:
      return "text";
    case ValueType::triple:
      return "3 numbers";
    case ValueType::matrix:
      return "3 x 3 numbers";
    case ValueType::axis_angle:
      return "4 numbers";
    case ValueType::numbers:
      return "list of numbers";
    case ValueType::modes:
      return "list of {n, m, a}";
    case ValueType::windows:
      return "list of {from, to, every}";
    case ValueType::quantity:
      return "text with unit";
  }
  return {};
}

std::string range_text(const KeyDescription& key) {
  if (key.type == ValueType::boolean) return "true, false";
  if (key.type == ValueType::text) return "any";
  if (key.type == ValueType::word) return fmt::format("{}", fmt::join(key.words, ", "));
  return key.range.text() == Range{}.text() ? "finite" : key.range.text();
}

std::string default_text(const KeyDescription& key) {
  if (key.required) return "required";
  const auto value = default_value(key);
  if (!value) return "absent";
  return to_toml(key, *value) + (has_default_in_units(key) ? "; required with [units]" : "");
}

std::string or_dash(std::string_view text) { return text.empty() ? "–" : std::string(text); }

}  // namespace

std::vector<KeyReference> key_references() {
  std::vector<KeyReference> references;
  for (const KeyDescription& key : scene_keys()) {
    references.push_back({std::string(key.table), std::string(key.name),
                          key.kinds.empty() ? "all" : fmt::format("{}", fmt::join(key.kinds, ", ")),
                          or_dash(key.symbol), type_text(key), or_dash(key.unit), range_text(key), default_text(key),
                          std::string(key.description)});
  }
  return references;
}

}  // namespace vehd
