#pragma once

namespace vehd {

/// Lowest degree p of the harmonics in scenes and files.
constexpr int lowest_order = 4;
/// Highest degree p of the harmonics in scenes and files.
constexpr int highest_order = 64;

}  // namespace vehd
