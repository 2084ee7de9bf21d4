#pragma once

#include <vector>

#include "bie/bench/result.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// Seconds of the first step of the scene, and of each part of a steady one with its memory, against the degree; the
/// exponents with which they grow, and the fraction of the machine's measured peak at which their counted operations
/// run, see StepTimer.
/// @param orders  ascending
/// @throws InputError for a scene without dt
BenchResult bench_parts(Scene scene, const std::vector<int>& orders, int repeats, BenchObserver& observer);

}  // namespace vehd
