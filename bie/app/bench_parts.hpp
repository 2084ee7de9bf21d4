#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd {

/// Prints and returns, per order, the median seconds of a whole step of the scene (evaluation and reparametrisation
/// included), the mean seconds of its parts, the growth exponent against the order before, and the peak memory of
/// the process so far.
nlohmann::json bench_parts(Scene scene, const std::vector<int>& orders, int repeats);

}  // namespace vehd
