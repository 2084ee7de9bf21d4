#include "bie/scene/effective_scene.hpp"

#include <fmt/format.h>

#include <utility>

#include "bie/scene/schema.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd {

std::string effective_scene(const Scene& read) {
  Scene scene = read;
  if (scene.electric && scene.electric->direction != Triple{}) {
    scene.electric->field = std::exchange(scene.electric->direction, Triple{});
    scene.electric->field_magnitude = 0.0;
  }
  const bool several = !scene.vesicles.empty();
  const auto keys_of = [&](const Scene& one, std::string_view table, bool of_vesicle) {
    std::string text;
    for (const KeyDescription& key : scene_keys()) {
      if (key.table != table || !applies(key, one) || (several && is_of_vesicle(key) != of_vesicle)) continue;
      if (const auto value = key.get(one)) text += fmt::format("{} = {}\n", key.name, to_toml(key, *value));
    }
    return text;
  };
  std::string text;
  for (const TableDescription& table : scene_tables()) {
    const bool of_each = table.name == "shape" || table.name.starts_with("membrane.");
    if (!table.present(scene) || (several && of_each)) continue;
    text += fmt::format("{}[{}]  # {}\n", text.empty() ? "" : "\n", table.name, table.description);
    text += keys_of(scene, table.name, false);
  }
  for (std::size_t a = 0; a < scene.vesicles.size(); ++a) {
    const Scene one = alone(scene, a);
    text += fmt::format("\n[[vesicle]]\nname = {}\n", to_toml(Value(scene.vesicles[a].name)));
    for (const TableDescription& table : scene_tables()) {
      const std::string keys = table.present(one) ? keys_of(one, table.name, true) : "";
      if (!keys.empty()) text += fmt::format("[vesicle.{}]\n{}", table.name, keys);
    }
  }
  return text;
}

}  // namespace vehd
