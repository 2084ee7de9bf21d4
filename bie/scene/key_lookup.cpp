#include "bie/scene/key_lookup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "bie/scene/nearest_name.hpp"
#include "bie/scene/read/toml_values.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Parts of "vesicle[1].shape.axes": the number of the vesicle and "shape.axes"; nullopt for other names.
std::optional<std::pair<std::size_t, std::string>> parts_of_name(const std::string& name) {
  constexpr std::string_view start = "vesicle[";
  const std::size_t end = name.find("].");
  if (!name.starts_with(start) || end == std::string::npos) return std::nullopt;
  return std::pair{static_cast<std::size_t>(std::stoul(name.substr(start.size()))), name.substr(end + 2)};
}

/// The row of a key that applies to a scene of one vesicle; null if there is none.
const KeyDescription* row_of(const Scene& scene, const std::string& name) {
  const auto& rows = scene_keys();
  const auto found = std::ranges::find_if(rows, [&](const KeyDescription& key) {
    return fmt::format("{}.{}", key.table, key.name) == name && applies(key, scene);
  });
  return found == rows.end() ? nullptr : &*found;
}

toml::table table_of(const SceneSource& source) {
  const std::string file = source.file.string();
  try {
    toml::table table = source.text ? toml::parse(*source.text, file) : toml::parse_file(file);
    apply_settings(table, source.settings);
    return table;
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: {}", file, error.source().begin.line, error.description()));
  }
}

}  // namespace

std::string key_text(const Scene& scene, const std::string& name) {
  if (const auto vesicle = parts_of_name(name)) return key_text(alone(scene, vesicle->first), vesicle->second);
  if (name == "vesicle.name" && !scene.vesicles.empty()) {
    return fmt::format("\"{}\"", fmt::join(vesicle_names(scene), "\", \""));
  }
  const KeyDescription* key = row_of(scene, name);
  const auto value = key != nullptr ? key->get(scene) : std::nullopt;
  return value ? to_toml(*key, *value) : "";
}

std::string_view key_dimension(const Scene& scene, const std::string& name) {
  if (const auto vesicle = parts_of_name(name)) return key_dimension(alone(scene, vesicle->first), vesicle->second);
  const KeyDescription* key = row_of(scene, name);
  return key != nullptr ? std::string_view(key->unit) : "";
}

std::vector<const KeyDescription*> keys_named(const std::string& name, const std::string& place,
                                              std::string_view where) {
  const std::size_t dot = name.rfind('.');
  const std::string table = name.substr(0, dot), word = dot == std::string::npos ? "" : name.substr(dot + 1);
  std::vector<const KeyDescription*> found;
  std::vector<std::string> all;
  for (const KeyDescription& description : scene_keys()) {
    all.push_back(fmt::format("{}.{}", description.table, description.name));
    if (description.table == table && description.is_called(word)) found.push_back(&description);
  }
  if (!found.empty()) return found;
  if (const auto of_table = key_names(table); !of_table.empty()) {
    throw InputError(
        fmt::format("{}: unknown key \"{}\" of [{}] in {}; {}", place, word, table, where, suggestion(word, of_table)));
  }
  throw InputError(fmt::format("{}: \"{}\" in {} is not a \"table.key\" of a scene; did you mean \"{}\"?", place,
                               shortened(name), where, nearest_name(name, {all.begin(), all.end()})));
}

bool is_given(const SceneSource& source, const std::string& name) {
  const toml::table table = table_of(source);
  return static_cast<bool>(table.at_path(name));
}

std::string key_place(const SceneSource& source, const std::string& name) {
  const std::string file = source.file.string();
  const toml::table table = table_of(source);
  const auto vesicle = parts_of_name(name);
  const std::string plain = vesicle ? vesicle->second : name;
  const std::size_t last = plain.rfind('.');
  const KeyDescription* key = find_key(plain.substr(0, last), plain.substr(last + 1));
  if (key != nullptr && !key->other_name.empty()) {
    const auto node = table.at_path(fmt::format("{}.{}", key->table, key->other_name));
    if (node) return place(*node.node(), file);
  }
  // In this order: the value of the vesicle, the value for all vesicles, the table of the vesicle.
  if (vesicle && !table.at_path(name)) {
    if (const auto node = table.at_path(plain)) return place(*node.node(), file);
  }
  for (std::string path = name; !path.empty();) {
    if (const auto node = table.at_path(path)) return place(*node.node(), file);
    const std::size_t dot = path.rfind('.');
    path.resize(dot == std::string::npos ? 0 : dot);
  }
  return file + ":1";
}

}  // namespace vehd
