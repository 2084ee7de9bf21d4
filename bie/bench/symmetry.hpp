#pragma once

#include <vector>

#include "bie/bench/result.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// Seconds of a step of the scene at each degree with the symmetry that it has and with the full solver, and how far
/// the states are from each other after the same steps. Both take their steps in turn, so that they see the same load
/// of the machine.
/// @throws InputError for a scene without dt or without symmetry
BenchResult bench_symmetry(Scene scene, const std::vector<int>& orders, int repeats, BenchObserver& observer);

}  // namespace vehd
