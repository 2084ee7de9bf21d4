#pragma once

#include "bie/runs/run_directory.hpp"
#include "bie/scene/output_units.hpp"

namespace vehd {

/// The units of the files of a run, which are those that its history began with; pictures of a run show its numbers in
/// these. All dimensionless where there is no history.
/// @throws InputError if scene.toml or history.csv cannot be read
OutputUnits units_of_run(const RunPaths& paths);

}  // namespace vehd
