#pragma once

namespace vehd {

/// Degrees p of the harmonics that scenes and files may have.
constexpr int lowest_order = 4;
/// See lowest_order.
constexpr int highest_order = 64;

}  // namespace vehd
