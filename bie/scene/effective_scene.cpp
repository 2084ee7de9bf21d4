#include "bie/scene/effective_scene.hpp"

#include <fmt/format.h>

#include "bie/scene/schema.hpp"
#include "bie/scene/toml_text.hpp"

namespace vehd {

std::string effective_scene(const Scene& scene) {
  std::string text;
  for (const TableDescription& table : scene_tables()) {
    if (!table.present(scene)) continue;
    text += fmt::format("{}[{}]  # {}\n", text.empty() ? "" : "\n", table.name, table.description);
    for (const KeyDescription& key : scene_keys()) {
      if (key.table != table.name || !applies(key, scene)) continue;
      if (const auto value = key.get(scene)) text += fmt::format("{} = {}\n", key.name, to_toml(key, *value));
    }
  }
  return text;
}

}  // namespace vehd
