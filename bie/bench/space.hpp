#pragma once

#include <vector>

#include "bie/bench/result.hpp"

namespace vehd {

/// Errors in space against the degree and the seconds: q and f_E of Example 1, and the velocity of a 2:1 prolate pulled
/// along and across its axis, whose exact velocity is constant, with the poles of the grid off the axis. All errors are
/// relative maxima over the nodes. The table `equal` has the lowest degree, seconds and memory at which f_E and the
/// velocity are right to 1e-4, 1e-7 and 1e-10, empty where twice the largest of the asked degrees, 64 at most, is not
/// enough.
/// @throws ConvergenceError
BenchResult bench_space(const std::vector<int>& orders, int repeats, BenchObserver& observer);

}  // namespace vehd
