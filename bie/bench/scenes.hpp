#pragma once

#include <filesystem>
#include <vector>

#include "bie/bench/result.hpp"

namespace vehd {

/// Runs the scenes as they are, files and pictures included: their final values and cost. Pictures go to the
/// folder as SCENE_shapes.png and SCENE_history.png; nothing else is left of the runs.
/// @throws ConvergenceError where a run does not reach its end
BenchResult bench_scenes(const std::vector<std::filesystem::path>& scenes, const std::filesystem::path& pictures,
                         BenchObserver& observer);

/// The scene files of a folder by name, or the one scene file that is given.
/// @throws InputError if there are none
std::vector<std::filesystem::path> scene_files(const std::filesystem::path& place);

}  // namespace vehd
