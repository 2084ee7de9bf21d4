#include "bie/fit/noise.hpp"

#include <cmath>
#include <numbers>

namespace vehd {

double NormalNumbers::operator()() {
  constexpr double step = 0x1p-53;
  // radius is in (0, 1], so that its logarithm exists, and turn in [0, 1).
  const double radius = static_cast<double>((generator_() >> 11) + 1) * step;
  const double turn = static_cast<double>(generator_() >> 11) * step;
  return std::sqrt(-2.0 * std::log(radius)) * std::cos(2.0 * std::numbers::pi * turn);
}

}  // namespace vehd
