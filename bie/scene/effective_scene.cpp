#include "bie/scene/effective_scene.hpp"

#include <fmt/format.h>

#include "bie/scene/schema.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd {

namespace {

/// The keys of a table that are asked for.
template <typename Wanted>
std::string keys_of(const Scene& scene, std::string_view table, const Wanted& wanted) {
  std::string text;
  for (const KeyDescription& key : scene_keys()) {
    if (key.table != table || !applies(key, scene) || !wanted(key)) continue;
    if (const auto value = key.get(scene)) text += fmt::format("{} = {}\n", key.name, to_toml(key, *value));
  }
  return text;
}

/// One table [[vesicle]] with all that may differ from vesicle to vesicle.
std::string vesicle_text(const Scene& one, const std::string& name) {
  std::string text = fmt::format("\n[[vesicle]]\nname = {}\n", to_toml(Value(name)));
  for (const TableDescription& table : scene_tables()) {
    if (!table.present(one)) continue;
    const std::string keys = keys_of(one, table.name, [](const KeyDescription& key) { return is_of_vesicle(key); });
    if (!keys.empty()) text += fmt::format("[vesicle.{}]\n{}", table.name, keys);
  }
  return text;
}

}  // namespace

std::string effective_scene(const Scene& scene) {
  const bool several = !scene.vesicles.empty();
  std::string text;
  for (const TableDescription& table : scene_tables()) {
    const bool of_each = table.name == "shape" || table.name.starts_with("membrane.");
    if (!table.present(scene) || (several && of_each)) continue;
    text += fmt::format("{}[{}]  # {}\n", text.empty() ? "" : "\n", table.name, table.description);
    text += keys_of(scene, table.name, [&](const KeyDescription& key) { return !several || !is_of_vesicle(key); });
  }
  for (std::size_t a = 0; a < scene.vesicles.size(); ++a) {
    text += vesicle_text(alone(scene, a), scene.vesicles[a].name);
  }
  return text;
}

}  // namespace vehd
