#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd {

/// Runs the scene to time `at` with every step size, prints the history quantities there with the seconds, then the
/// order observed from each three successive step sizes and the value extrapolated to dt = 0 at that order.
/// @param steps  each half of the one before
nlohmann::json bench_time(const Scene& scene, const std::vector<double>& steps, double at);

/// Runs the scene to time `at` with falling tolerances and prints the error of each against the last, beside the
/// seconds that it took. @throws InputError, ConvergenceError
nlohmann::json bench_tolerance(const Scene& scene, const std::vector<double>& tolerances, double at);

}  // namespace vehd
