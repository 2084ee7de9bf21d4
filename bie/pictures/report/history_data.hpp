#pragma once

#include <nlohmann/json.hpp>

#include "bie/runs/history.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// Plots of a page: "panels" of up to four curves each, those that the effects of the scene and the columns of the
/// history allow. A long history is thinned out so that no peak is lost; of one row there are no panels.
nlohmann::json history_data(const HistoryTable& history, const Scene& scene);

}  // namespace vehd
