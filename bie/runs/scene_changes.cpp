#include "bie/runs/scene_changes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string_view>

#include "bie/scene/key_lookup.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/schema.hpp"
#include "bie/scene/units.hpp"

namespace vehd {
namespace {

/// The numbers of a value as texts with an SI unit; the digits leave out rounding errors of the conversion.
nlohmann::json with_unit(const nlohmann::json& value, double scale, std::string_view dimension) {
  if (value.is_number()) return si_number(value.get<double>() * scale, dimension, 12);
  nlohmann::json result = value;
  if (value.is_array()) {
    for (nlohmann::json& part : result) part = with_unit(part, scale, dimension);
  }
  return result;
}

}  // namespace

nlohmann::json value_of(const Scene& scene, const std::string& key) {
  const std::string text = key_text(scene, key);
  if (text.empty()) return {};
  // Numbers and words of TOML are valid JSON.
  const nlohmann::json value = nlohmann::json::parse(text);
  const Dimension* dimension = find_dimension(key_dimension(scene, key));
  if (!scene.units || dimension == nullptr) return value;
  const double scale = si_scale(scene.units, dimension->name);
  return std::isnan(scale) ? value : with_unit(value, scale, dimension->name);
}

std::string shown(const nlohmann::json& value) {
  if (value.is_null()) return "absent";
  if (!value.is_array()) return value.dump();
  std::vector<std::string> parts;
  for (const nlohmann::json& part : value) parts.push_back(shown(part));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

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
