#include "bie/scene/varied_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <exception>

#include "bie/scene/nearest_name.hpp"
#include "bie/scene/schema.hpp"
#include "bie/scene/toml_text.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/scene/units.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

constexpr const char* values_form = "values = [...], or from, to and count, with scale = \"linear\" or \"log\"";

/// One line of TOML.
std::string value_text(const toml::node& node) {
  if (const auto* text = node.as_string()) return to_toml(Value(text->get()));
  if (const auto* number = node.as_floating_point()) return to_toml(Value(number->get()));
  if (const auto* number = node.as_integer()) return to_toml(Value(number->get()));
  if (const auto* truth = node.as_boolean()) return to_toml(Value(truth->get()));
  std::vector<std::string> parts;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& part : *array) parts.push_back(value_text(part));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, part] : *table) parts.push_back(fmt::format("{} = {}", key.str(), value_text(part)));
    return fmt::format("{{{}}}", fmt::join(parts, ", "));
  }
  return shown(node);
}

VariedValue varied_value(const toml::node& node) {
  const std::string toml = value_text(node);
  return {toml, node.is_string() ? node.as_string()->get() : toml};
}

/// One key of [vary] in its file.
struct VariedPlace {
  const std::string& name;
  const toml::table& table;
  const std::string& file;

  [[noreturn]] void refuse(const toml::node& node, const std::string& problem) const {
    throw InputError(fmt::format("{}: \"{}\" in [vary] {}", place(node, file), name, problem));
  }
};

/// All rows of the key: one for each kind that has another.
std::vector<const KeyDescription*> descriptions_of(const VariedPlace& key) {
  const std::size_t dot = key.name.rfind('.');
  const std::string table = key.name.substr(0, dot), word = dot == std::string::npos ? "" : key.name.substr(dot + 1);
  std::vector<std::string> all;
  std::vector<std::string_view> of_table;
  std::vector<const KeyDescription*> found;
  for (const KeyDescription& description : scene_keys()) {
    all.push_back(fmt::format("{}.{}", description.table, description.name));
    if (description.table == table) of_table.push_back(description.name);
    if (description.table == table && description.is_called(word)) found.push_back(&description);
  }
  if (!found.empty()) return found;
  if (!of_table.empty()) {
    throw InputError(fmt::format("{}: unknown key \"{}\" of [{}] in [vary]; {}", place(key.table, key.file), word,
                                 table, suggestion(word, of_table)));
  }
  const std::vector<std::string_view> names(all.begin(), all.end());
  const auto nearest = std::min_element(names.begin(), names.end(), [&](std::string_view a, std::string_view b) {
    return edit_distance(key.name, a) < edit_distance(key.name, b);
  });
  throw InputError(fmt::format("{}: \"{}\" in [vary] is no \"table.key\" of a scene; did you mean \"{}\"?",
                               place(key.table, key.file), shortened(key.name), *nearest));
}

/// @throws what the first description says where none accepts the value
void require_accepted(const std::vector<const KeyDescription*>& descriptions, const toml::node& node,
                      const std::string& file, const std::optional<UnitsScene>& units) {
  std::exception_ptr first;
  for (const KeyDescription* description : descriptions) {
    try {
      static_cast<void>(checked_value(*description, node, file, units));
      return;
    } catch (const InputError&) {
      if (!first) first = std::current_exception();
    }
  }
  std::rethrow_exception(first);
}

/// One end of a range: a number, or one with a unit.
Quantity end_of_range(const VariedPlace& key, const char* name) {
  const toml::node* node = key.table.get(name);
  if (node == nullptr) key.refuse(key.table, fmt::format("has no \"{}\"; accepted: {}", name, values_form));
  if (const auto number = number_of(*node)) return {*number, ""};
  const auto* text = node->as_string();
  const auto quantity = text != nullptr ? parse_quantity(text->get()) : std::nullopt;
  if (!quantity) key.refuse(*node, fmt::format("has {} = {}; accepted: a number", name, shown(*node)));
  return *quantity;
}

/// The shortest number within rounding: 0.3 and not 0.30000000000000004.
double without_rounding(double value) {
  const std::string text = fmt::format("{:.14g}", value);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::vector<VariedValue> values_of_range(const VariedPlace& key, bool logarithmic, bool integer) {
  const Quantity from = end_of_range(key, "from"), to = end_of_range(key, "to");
  if (from.unit != to.unit) {
    key.refuse(*key.table.get("to"),
               fmt::format("goes from a value in \"{}\" to one in \"{}\"; accepted: one unit", from.unit, to.unit));
  }
  const toml::node* counted = key.table.get("count");
  const std::int64_t count = counted != nullptr ? counted->value<std::int64_t>().value_or(0) : 0;
  if (count < 2 || count > static_cast<std::int64_t>(most_runs)) {
    key.refuse(counted != nullptr ? *counted : static_cast<const toml::node&>(key.table),
               fmt::format("needs \"count\"; accepted: 2 ... {}", most_runs));
  }
  if (logarithmic && !(from.number * to.number > 0.0)) {
    key.refuse(*key.table.get("from"), "goes by equal factors; accepted: two numbers of one sign, none of them 0");
  }
  std::vector<VariedValue> values;
  for (std::int64_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    double value = logarithmic ? from.number * std::pow(to.number / from.number, share)
                               : from.number + share * (to.number - from.number);
    value = i == count - 1 ? to.number : without_rounding(value);
    if (integer && value != std::round(value)) {
      key.refuse(*counted, fmt::format("is a whole number and would become {}; accepted: another count", value));
    }
    const std::string number = integer ? to_toml(Value(static_cast<std::int64_t>(value))) : to_toml(Value(value));
    const std::string text = from.unit.empty() ? number : fmt::format("{} {}", number, from.unit);
    values.push_back({from.unit.empty() ? text : to_toml(Value(text)), text});
  }
  return values;
}

}  // namespace

VariedKey varied_key(const std::string& name, const toml::table& table, const std::string& file,
                     const std::optional<UnitsScene>& units) {
  const VariedPlace key{name, table, file};
  const std::vector<const KeyDescription*> descriptions = descriptions_of(key);
  const bool is_range = !table.contains("values");
  const std::vector<std::string_view> known =
      is_range ? std::vector<std::string_view>{"values", "from", "to", "count", "scale"}
               : std::vector<std::string_view>{"values"};
  for (const auto& [word, node] : table) {
    if (std::find(known.begin(), known.end(), word.str()) != known.end()) continue;
    key.refuse(node, fmt::format("has an unknown \"{}\"; {}", word.str(), suggestion(word.str(), known)));
  }
  VariedKey result{name, {}, false};
  if (is_range) {
    const toml::node* scale = table.get("scale");
    const std::string word = scale != nullptr ? scale->value<std::string>().value_or("") : "linear";
    if (word != "linear" && word != "log") {
      key.refuse(*scale, fmt::format("has scale = {}; accepted: \"linear\", \"log\"", shown(*scale)));
    }
    result.is_logarithmic = word == "log";
    const bool integer = descriptions.front()->type == ValueType::integer;
    result.values = values_of_range(key, result.is_logarithmic, integer);
    for (const char* end : {"from", "to"}) require_accepted(descriptions, *table.get(end), file, units);
    return result;
  }
  const toml::array* values = table.get("values")->as_array();
  if (values == nullptr || values->empty()) {
    key.refuse(*table.get("values"), fmt::format("has no list of values; accepted: {}", values_form));
  }
  for (const toml::node& node : *values) {
    require_accepted(descriptions, node, file, units);
    result.values.push_back(varied_value(node));
  }
  return result;
}

}  // namespace vehd
