#pragma once

#include <algorithm>

#include "bie/support/types.hpp"

namespace vehd {

/// Nodes that are looked at together, as many as a register holds: one instruction each of what compilers would else do
/// one by one.
constexpr Index kTogether = std::max(4, int{Eigen::internal::packet_traits<double>::size});
using Few = Eigen::Array<double, kTogether, 1>;

/// The values that stand from there on.
inline Few few(const double* at) { return Eigen::Map<const Few>(at); }

}  // namespace vehd
