#include "bie/scene/schema_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "bie/scene/schema.hpp"
#include "bie/scene/units.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/support/text_table.hpp"

namespace vehd {
namespace {

constexpr const char* page_start =
    R"(# Keys of a scene file

A scene is a TOML file with the tables below. A key that is left out has its default, and an effect whose table is left
out is absent. Unknown keys, wrong types, wrong units and values out of range are errors that name the line. A run
writes the scene with every default to `scene.toml`. This page is printed by

```sh
build/vehd help scene --markdown > docs/scene_keys.md
```

Values are dimensionless, in any consistent scales; `build/vehd help groups SCENE.toml` prints the numbers that do
not depend on them. With a table `[units]`, even an empty one, a number that has a dimension may instead be a text
with an SI unit, `"10 um"`, also as a component of a vector, `[0, 0, "1 kV/cm"]`; it is divided by the reference
scale of its dimension (section Units). A plain number is in units of the reference scale. A key whose default is a
number with a dimension, other than 0, is then required. Results are shown in SI units as well
([units](units.md)). Energies may be in `kBT` where `[units]` has a `temperature`. Shapes of other
runs: [starting from a shape](continuing.md#starting-from-a-shape-kind--file).
)";

constexpr const char* several_text = R"(
## Several vesicles

The tables above are for all [vesicles of a scene](several_vesicles.md); each table `[[vesicle]]` has the keys that
differ for one of them:

)";

constexpr const char* several_rules = R"(
A `[vesicle.shape]` with a `kind` replaces `[shape]`; without one it changes single keys, such as
`centre`. `name` is by default the number from 0. Scales of `[units]` that are not given follow from the first vesicle.
)";

std::string range_text(const KeyDescription& key) {
  if (key.type == ValueType::boolean) return "true, false";
  if (key.type == ValueType::text) return "any";
  if (key.type == ValueType::word) return key.accepted_text();
  return key.range.text() == Range{}.text() ? "finite" : key.range.text();
}

std::string default_text(const KeyDescription& key) {
  if (key.required) return "required";
  const auto value = default_value(key);
  if (!value) return "absent";
  return to_toml(key, *value) + (has_default_in_units(key) ? "; required with [units]" : "");
}

std::string or_dash(std::string_view text) { return text.empty() ? "–" : std::string(text); }

/// Keys that may differ between vesicles.
TextTable own_keys() {
  TextTable rows = {{"table", "keys"}, {"[[vesicle]]", "name"}};
  for (const std::string_view table : vesicle_tables()) {
    std::vector<std::string_view> names = key_names(table);
    const bool whole = std::erase_if(names, [&](std::string_view key) { return !is_of_vesicle(table, key); }) == 0;
    rows.push_back({fmt::format("[vesicle.{}]", table), whole ? "all" : fmt::format("{}", fmt::join(names, ", "))});
  }
  return rows;
}

/// Header and keys of a table; with a column of kinds only if there are any.
TextTable key_table(const TableDescription& table) {
  TextTable rows = {{"key", "of kind", "symbol", "type", "unit", "range", "default", "meaning"}};
  for (const KeyReference& key : key_references()) {
    if (key.table != table.name) continue;
    rows.push_back({key.name, key.kinds, key.symbol, key.type, key.unit, key.range, key.default_value, key.meaning});
  }
  if (kind_key(table.name) != nullptr) return rows;
  for (auto& row : rows) row.erase(row.begin() + 1);
  return rows;
}

/// Keys of a table in Markdown; a link replaces those that an earlier table has as well.
std::string keys_markdown(const TableDescription& table) {
  const TextTable rows = key_table(table);
  for (const TableDescription& earlier : scene_tables()) {
    if (earlier.name == table.name) break;
    const TextTable shared = key_table(earlier);
    if (shared.size() > rows.size() || !std::ranges::equal(shared, std::span(rows).first(shared.size()))) continue;
    std::string anchor(earlier.name);
    std::erase(anchor, '.');
    const std::string text = fmt::format("The keys of [{}](#{})", earlier.name, anchor);
    if (shared.size() == rows.size()) return text + ".\n";
    TextTable further = {rows.front()};
    further.insert(further.end(), rows.begin() + static_cast<std::ptrdiff_t>(shared.size()), rows.end());
    return text + ", and\n\n" + markdown_table(further);
  }
  return markdown_table(rows);
}

/// Dimensions that occur in keys, with their reference scales and units.
TextTable unit_table() {
  TextTable rows = {{"dimension", "reference scale", "units"}};
  for (const Dimension& dimension : dimensions()) {
    if (std::ranges::find(scene_keys(), dimension.name, &KeyDescription::unit) == scene_keys().end()) continue;
    rows.push_back({std::string(dimension.name), dimension.scale_text(), dimension.accepted()});
  }
  return rows;
}

std::string presence(const TableDescription& table) { return table.required ? " (required)" : ""; }

}  // namespace

std::vector<KeyReference> key_references() {
  std::vector<KeyReference> references;
  for (const KeyDescription& key : scene_keys()) {
    references.push_back({std::string(key.table), std::string(key.name),
                          key.kinds.empty() ? "all" : fmt::format("{}", fmt::join(key.kinds, ", ")),
                          or_dash(key.symbol), std::string(key.type_text()), or_dash(key.unit), range_text(key),
                          default_text(key), std::string(key.description)});
  }
  return references;
}

std::string scene_help() {
  std::string text;
  for (const TableDescription& table : scene_tables()) {
    text += fmt::format("[{}]  {}{}\n", table.name, table.description, presence(table));
    text += aligned(key_table(table), "  ") + "\n";
  }
  text +=
      "[[vesicle]]  one of several vesicles, with the keys that differ from those of all; a [vesicle.shape] with a "
      "kind "
      "takes the place of [shape]\n" +
      aligned(own_keys(), "  ") + "\n";
  return text + "Units of a scene with [units], as in \"10 um\"\n" + aligned(unit_table(), "  ");
}

std::string scene_help_markdown() {
  std::string text = page_start;
  for (const TableDescription& table : scene_tables()) {
    text += fmt::format("\n## [{}]\n\n{}{}.\n\n", table.name, table.description, presence(table));
    text += keys_markdown(table);
  }
  text += several_text + markdown_table(own_keys()) + several_rules;
  return text + "\n## Units\n\n" + markdown_table(unit_table());
}

}  // namespace vehd
