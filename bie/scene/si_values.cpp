#include "bie/scene/si_values.hpp"

#include <algorithm>
#include <cmath>

#include "bie/scene/schema.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/scene/units.hpp"

namespace vehd {
namespace {

/// A value of a key, or a part of it.
struct Part {
  const KeyDescription& key;
  const std::string& file;
  const UnitsScene& units;

  /// nullopt for a number without a unit; a plain zero has every unit.
  [[nodiscard]] std::optional<double> magnitude(const toml::node& node) const {
    const auto si = si_number(key, node, file, units);
    if (!si && number_of(node) == 0.0) return 0.0;
    return si ? std::optional(std::abs(*si)) : std::nullopt;
  }

  /// Of an array the length, of an array of arrays the largest length of a row.
  [[nodiscard]] std::optional<double> size(const toml::node& node) const {
    const toml::array* array = node.as_array();
    if (array == nullptr || key.type == ValueType::number) return magnitude(node);
    double length = 0.0, largest_row = 0.0;
    for (const toml::node& entry : *array) {
      const auto of_entry = size(entry);
      if (!of_entry) return std::nullopt;
      if (entry.is_array()) {
        largest_row = std::max(largest_row, *of_entry);
      } else {
        length = std::hypot(length, *of_entry);
      }
    }
    return std::max(length, largest_row);
  }
};

}  // namespace

bool SiValues::has_table(std::string_view table) const { return file_.at_path(table).is_table(); }

bool SiValues::is_true(std::string_view table, std::string_view key) const {
  return file_.at_path(table)[key].value_or(false);
}

std::optional<double> SiValues::size(std::string_view table, std::string_view key) const {
  const KeyDescription* description = find_key(table, key);
  const toml::node* node = file_.at_path(table)[key].node();
  if (description == nullptr || node == nullptr) return std::nullopt;
  const auto size = Part{*description, name_, units_}.size(*node);
  return size && *size > 0.0 ? size : std::nullopt;
}

}  // namespace vehd
