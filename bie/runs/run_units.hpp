#pragma once

#include <filesystem>
#include <optional>

#include "bie/runs/run_directory.hpp"
#include "bie/scene/output_units.hpp"

namespace vehd {

/// The units that a history began with; all dimensionless where there is none.
/// @param scales  of the scene of the run
OutputUnits units_of_history(const std::filesystem::path& history, const std::optional<UnitsScene>& scales);

/// The units of the files of a run, which are those that its history began with; pictures of a run show its numbers in
/// these. All dimensionless where there is no history.
/// @throws InputError if scene.toml cannot be read
OutputUnits units_of_run(const RunPaths& paths);

}  // namespace vehd
