#include "bie/scene/key_lookup.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "bie/scene/schema.hpp"
#include "bie/scene/toml_text.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

std::string key_text(const Scene& scene, const std::string& name) {
  for (const KeyDescription& key : scene_keys()) {
    if (fmt::format("{}.{}", key.table, key.name) != name || !applies(key, scene)) continue;
    const auto value = key.get(scene);
    return value ? to_toml(key, *value) : "";
  }
  return "";
}

std::string key_place(const SceneSource& source, const std::string& name) {
  const std::string file = source.file.string();
  try {
    toml::table table = toml::parse_file(file);
    apply_settings(table, source.settings);
    const std::size_t last = name.rfind('.');
    const KeyDescription* key = find_key(name.substr(0, last), name.substr(last + 1));
    if (key != nullptr && !key->other_name.empty()) {
      const auto node = table.at_path(fmt::format("{}.{}", key->table, key->other_name));
      if (node) return place(*node.node(), file);
    }
    for (std::string path = name; !path.empty();) {
      if (const auto node = table.at_path(path)) return place(*node.node(), file);
      const std::size_t dot = path.rfind('.');
      path.resize(dot == std::string::npos ? 0 : dot);
    }
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: {}", file, error.description()));
  }
  return file + ":1";
}

}  // namespace vehd
