#pragma once

#include <vector>

#include "bie/bench/result.hpp"

namespace vehd {

/// Errors in space against the degree and the seconds: q and f_E of Example 1, and the velocity of a 2:1 prolate pulled
/// along and across its axis, whose exact velocity is constant, with the poles of the grid off the axis. All errors are
/// relative maxima over the nodes. @throws ConvergenceError
BenchResult bench_space(const std::vector<int>& orders, int repeats, BenchObserver& observer);

}  // namespace vehd
