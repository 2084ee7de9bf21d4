#pragma once

#include <nlohmann/json.hpp>

#include "bie/app/history.hpp"
#include "bie/app/run_loop.hpp"

namespace vehd {

/// Content of summary.json.
nlohmann::json summary_of(const HistoryTable& history, const Scene& scene, const Checkpoint& checkpoint,
                          const RunOutcome& outcome);

/// Most memory that this process has held.
std::int64_t peak_memory_bytes();

}  // namespace vehd
