#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd {

/// A key that a session of a run found changed in the scene, and the time and step of the run then.
struct SceneChange {
  double time = 0.0;
  std::int64_t step = 0;         ///< accepted steps before the change
  std::string key;               ///< "table.key"
  nlohmann::json before, after;  ///< null if the scene has no value

  bool operator==(const SceneChange&) const = default;
};

/// Value of a key, null if the scene has none. With [units] a number that has a dimension is a text in SI units:
/// "0.01 F/m^2".
nlohmann::json value_of(const Scene& scene, const std::string& key);
/// A value in a message.
std::string shown(const nlohmann::json& value);

/// Changes of the computation between the scenes of two sessions, without the end time and [output].
std::vector<SceneChange> changes_between(const Scene& before, const Scene& after, double time, std::int64_t step);

/// An array of objects {time, step, key, from, to}.
nlohmann::json json_of(const std::vector<SceneChange>& changes);
/// Changes from JSON, the inverse of the above. @throws nlohmann::json::exception
std::vector<SceneChange> changes_of(const nlohmann::json& json);

/// "time 1.5 (step 30): numerics.dt = 0.01, before 0.05"
std::string text_of(const SceneChange& change);

/// The text of a scene with the changes of its run as comments at the top.
std::string with_changes(const std::string& scene, const std::vector<SceneChange>& changes);

}  // namespace vehd
