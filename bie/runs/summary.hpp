#pragma once

#include <nlohmann/json.hpp>

#include "bie/runs/history.hpp"
#include "bie/runs/run_loop.hpp"
#include "bie/scene/model_range.hpp"

namespace vehd {

/// Content of summary.json.
/// @param of_each  the table with a row for each vesicle; `history` if there is one vesicle
/// @return  the stable keys of the command `run`, and others
nlohmann::json summary_of(const HistoryTable& history, const HistoryTable& of_each, const Scene& scene,
                          const Checkpoint& checkpoint, const RunOutcome& outcome);

/// An array of objects {name, value, limit, text}.
nlohmann::json json_of(const std::vector<ModelWarning>& warnings);

/// Motion in shear at the end of the history of one vesicle, from the second half of its times:
///   "tumbling"       the tumbling angle ψ changes by half a revolution or more
///   "tank-treading"  ψ stays within a degree while the membrane treads a quarter of a revolution or more
///   "trembling"      ψ swings back and forth by more than a degree
///   "unsettled"      none of these, for instance because the run is too short
/// Empty if nothing turns, or without the columns of turning. ψ may change by less than 90° from row to row.
/// @param units  of the history
/// Source: the three motions: Misbah 2006; trembling is vacillating-breathing there
std::string regime_of(const HistoryTable& history, const OutputUnits& units);

}  // namespace vehd
