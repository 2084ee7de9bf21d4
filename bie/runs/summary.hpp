#pragma once

#include <nlohmann/json.hpp>

#include "bie/runs/history.hpp"
#include "bie/runs/run_loop.hpp"
#include "bie/scene/model_range.hpp"

namespace vehd {

/// Content of summary.json.
/// @return  the stable keys of the command `run`, and more
nlohmann::json summary_of(const HistoryTable& history, const Scene& scene, const Checkpoint& checkpoint,
                          const RunOutcome& outcome);

/// Entries name, value, limit and text.
nlohmann::json json_of(const std::vector<ModelWarning>& warnings);

}  // namespace vehd
