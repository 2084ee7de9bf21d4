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

/// The motion in shear that a history of one vesicle ends with, by the second half of its time and the angle ψ by
/// which the shape turns about the vorticity:
///   "tumbling"       ψ turns by half a revolution or more
///   "tank-treading"  ψ stays within a degree while the membrane treads a quarter of a revolution or more
///   "trembling"      ψ swings by more than a degree, back and forth
///   "unsettled"      none of these, as before the vesicle has reached its motion; longer runs tell more
/// Empty without columns of turning and where nothing turns.
/// @param units  of the history
/// Source: the three motions: Misbah 2006; trembling is vacillating-breathing there
std::string regime_of(const HistoryTable& history, const OutputUnits& units);

}  // namespace vehd
