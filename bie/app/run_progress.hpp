#pragma once

#include "bie/runs/run_status.hpp"
#include "bie/support/progress.hpp"

namespace vehd {

/// Shows where a run is, and how long the rest of it may take.
void show_run(Progress& progress, const RunStatus& status);

}  // namespace vehd
