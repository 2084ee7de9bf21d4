#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bie/stepping/solve/motion.hpp"
#include "bie/support/ranks/shares.hpp"

namespace vehd {

/// The motions of n vesicles, each found by the rank that owns it. Collective.
/// @param iterations  counter of the solves; grows by those of all vesicles, where one has no motion by those up to it
/// @param one         the motion of one vesicle, which counts its iterations there
/// @throws ConvergenceError  that of the first vesicle without a motion, on all ranks
std::vector<Motion> shared_motions(const Shares& shares, std::size_t n, int& iterations,
                                   const std::function<Motion(std::size_t)>& one);

}  // namespace vehd
