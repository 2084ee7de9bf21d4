#pragma once

#include <vector>

#include "bie/bench/result.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// 1, 2, 4, … and the number of hardware threads.
std::vector<int> thread_counts();

/// Seconds of each part of a step of the scene against the number of threads, speed-up and efficiency against the first
/// count, and how far the state after the same steps is from the one that the first count reaches. Repeats go round
/// the counts, so that all see the same load of the machine.
/// @throws InputError for a scene without dt
BenchResult bench_threads(Scene scene, const std::vector<int>& counts, int repeats, BenchObserver& observer);

}  // namespace vehd
