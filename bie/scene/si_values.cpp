#include "bie/scene/si_values.hpp"

#include <algorithm>
#include <cmath>

#include "bie/scene/schema.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/scene/units.hpp"

namespace vehd {
namespace {

/// nullopt for what is no number with a unit of the dimension; a plain zero has every unit.
std::optional<double> magnitude(const toml::node& node, const Dimension& dimension, std::optional<double> temperature) {
  if (const auto number = number_of(node)) return *number == 0.0 ? number : std::nullopt;
  const toml::value<std::string>* text = node.as_string();
  const auto quantity = text == nullptr ? std::nullopt : parse_quantity(text->get());
  const Unit* unit = quantity ? dimension.find(quantity->unit) : nullptr;
  if (unit == nullptr || (unit->per_kelvin && !temperature)) return std::nullopt;
  return std::abs(quantity->in_si(*unit, temperature));
}

/// Of an array the length, of an array of arrays the largest length of a row.
std::optional<double> size_of(const toml::node& node, const Dimension& dimension, std::optional<double> temperature) {
  const toml::array* array = node.as_array();
  if (array == nullptr) return magnitude(node, dimension, temperature);
  double length = 0.0, largest_row = 0.0;
  for (const toml::node& entry : *array) {
    const auto size = size_of(entry, dimension, temperature);
    if (!size) return std::nullopt;
    if (entry.is_array()) {
      largest_row = std::max(largest_row, *size);
    } else {
      length = std::hypot(length, *size);
    }
  }
  return std::max(length, largest_row);
}

}  // namespace

bool SiValues::has_table(std::string_view table) const { return file_.at_path(table).is_table(); }

bool SiValues::is_true(std::string_view table, std::string_view key) const {
  return file_.at_path(table)[key].value_or(false);
}

std::optional<double> SiValues::size(std::string_view table, std::string_view key) const {
  const KeyDescription* description = find_key(table, key);
  const Dimension* dimension = description == nullptr ? nullptr : find_dimension(description->unit);
  const toml::node* node = file_.at_path(table)[key].node();
  if (dimension == nullptr || node == nullptr) return std::nullopt;
  const auto size = size_of(*node, *dimension, temperature_);
  return size && *size > 0.0 ? size : std::nullopt;
}

}  // namespace vehd
