#include "bie/scene/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/scene/key_rows.hpp"
#include "bie/scene/units.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd {

bool Range::contains(double value) const {
  return std::isfinite(value) && value <= upper && (lower_excluded ? value > lower : value >= lower);
}

std::string Range::text() const {
  if (std::isinf(lower) && std::isinf(upper)) return "any finite number";
  if (std::isinf(upper)) return fmt::format("{} {}", lower_excluded ? ">" : ">=", lower);
  return fmt::format("{} ... {}", lower, upper);
}

bool KeyDescription::is_called(std::string_view word) const {
  return !word.empty() && (word == name || word == other_name);
}

bool KeyDescription::takes(double value) const {
  const double magnitude = unit == "time" ? std::min(std::abs(value), 1.0) : value;
  return range.contains(value) && has_magnitude_in_range(magnitude);
}

bool KeyDescription::is_for(std::string_view kind) const {
  return kinds.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

const std::vector<TableDescription>& scene_tables() {
  static const std::vector<TableDescription> tables = table_rows();
  return tables;
}

const std::vector<KeyDescription>& scene_keys() {
  static const std::vector<KeyDescription> keys = key_rows();
  return keys;
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
  const auto table = std::find_if(scene_tables().begin(), scene_tables().end(),
                                  [&](const TableDescription& candidate) { return candidate.name == key.table; });
  return table->present(scene) && key.is_for(kind_of(scene, key.table));
}

std::optional<Value> default_value(const KeyDescription& key) {
  Scene scene;
  for (const TableDescription& table : scene_tables()) {
    if (table.name == key.table) table.create(scene);
  }
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

namespace {

/// @param names  to which those of keys in which two scenes of one vesicle differ are added
template <typename Wanted>
void add_differing_keys(const Scene& a, const Scene& b, const std::string& prefix, const Wanted& wanted,
                        std::vector<std::string>& names) {
  for (const KeyDescription& key : scene_keys()) {
    if (!wanted(key)) continue;
    const auto value_a = applies(key, a) ? key.get(a) : std::nullopt;
    const auto value_b = applies(key, b) ? key.get(b) : std::nullopt;
    const std::string name = fmt::format("{}{}.{}", prefix, key.table, key.name);
    if (value_a != value_b && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
}

}  // namespace

std::vector<std::string> differing_keys(const Scene& a, const Scene& b) {
  std::vector<std::string> names;
  if (a.vesicles.empty() && b.vesicles.empty()) {
    add_differing_keys(
        a, b, "", [](const KeyDescription&) { return true; }, names);
    return names;
  }
  if (vesicle_names(a) != vesicle_names(b)) return {"vesicle.name"};
  add_differing_keys(
      a, b, "", [](const KeyDescription& key) { return !is_of_vesicle(key); }, names);
  for (std::size_t v = 0; v < a.vesicles.size(); ++v) {
    add_differing_keys(
        alone(a, v), alone(b, v), fmt::format("vesicle[{}].", v),
        [](const KeyDescription& key) { return is_of_vesicle(key); }, names);
  }
  return names;
}

}  // namespace vehd
