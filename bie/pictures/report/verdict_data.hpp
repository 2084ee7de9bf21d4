#pragma once

#include <nlohmann/json.hpp>

#include "bie/runs/history.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// The verdict on a run for a page: "text", "state" (good, doubtful, stopped, unfinished) and "limits", each number
/// that is judged with its worst value, and "warnings", texts about the physics.
/// @param summary  of the run; not an object where it has none, being under way or killed
nlohmann::json verdict_data(const HistoryTable& history, const Scene& scene, const nlohmann::json& summary);

}  // namespace vehd
