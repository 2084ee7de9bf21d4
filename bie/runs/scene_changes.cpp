#include "bie/runs/scene_changes.hpp"

#include <fmt/format.h>

#include "bie/scene/key_lookup.hpp"
#include "bie/scene/schema.hpp"

namespace vehd {
namespace {

/// Numbers and words of TOML are valid JSON.
nlohmann::json value_of(const Scene& scene, const std::string& key) {
  const std::string text = key_text(scene, key);
  return text.empty() ? nlohmann::json() : nlohmann::json::parse(text);
}

std::string shown(const nlohmann::json& value) { return value.is_null() ? "absent" : value.dump(); }

}  // namespace

std::vector<SceneChange> changes_between(const Scene& before, const Scene& after, double time, std::int64_t step) {
  std::vector<SceneChange> changes;
  for (const std::string& key : differing_keys(before, after)) {
    if (key.starts_with("output.") || key == "numerics.end_time") continue;
    changes.push_back({time, step, key, value_of(before, key), value_of(after, key)});
  }
  return changes;
}

nlohmann::json json_of(const std::vector<SceneChange>& changes) {
  nlohmann::json json = nlohmann::json::array();
  for (const SceneChange& change : changes) {
    json.push_back({{"time", change.time},
                    {"step", change.step},
                    {"key", change.key},
                    {"from", change.before},
                    {"to", change.after}});
  }
  return json;
}

std::vector<SceneChange> changes_of(const nlohmann::json& json) {
  std::vector<SceneChange> changes;
  for (const auto& change : json) {
    changes.push_back({change.at("time").get<double>(), change.at("step").get<std::int64_t>(),
                       change.at("key").get<std::string>(), change.at("from"), change.at("to")});
  }
  return changes;
}

std::string text_of(const SceneChange& change) {
  return fmt::format("time {:g} (step {}): {} = {}, before {}", change.time, change.step, change.key,
                     shown(change.after), shown(change.before));
}

std::string with_changes(const std::string& scene, const std::vector<SceneChange>& changes) {
  std::string text;
  for (const SceneChange& change : changes) text += fmt::format("# changed at {}\n", text_of(change));
  return text + scene;
}

}  // namespace vehd
