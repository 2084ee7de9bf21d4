#pragma once

#include <nlohmann/json.hpp>

#include "bie/runs/history.hpp"
#include "bie/runs/run_loop.hpp"
#include "bie/scene/model_range.hpp"

namespace vehd {

/// Content of summary.json.
/// @return  the stable keys of the command `run`, and others
nlohmann::json summary_of(const HistoryTable& history, const Scene& scene, const Checkpoint& checkpoint,
                          const RunOutcome& outcome);

/// An array of objects {name, value, limit, text}.
nlohmann::json json_of(const std::vector<ModelWarning>& warnings);

/// Motion in shear at the end of a history of one vesicle, judged over the second half of its time by the angle ψ by
/// which the shape turns about the vorticity:
///   "tumbling"       ψ turns by half a revolution or more
///   "tank-treading"  ψ stays within a degree while the membrane treads a quarter of a revolution or more
///   "trembling"      ψ swings by more than a degree, back and forth
/// "unsettled"      none of these, as before the motion has settled; a longer run may decide
/// Empty if the history lacks the columns of turning, or if nothing turns.
/// @param units  of the history
/// Source: Misbah 2006 for the three motions; trembling is called vacillating-breathing there
std::string regime_of(const HistoryTable& history, const OutputUnits& units);

}  // namespace vehd
