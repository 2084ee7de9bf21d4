#include "bie/pictures/colour_map.hpp"

#include <algorithm>
#include <cstddef>

namespace vehd {

ColourMap ColourMap::diverging(double white) {
  return ColourMap({{0.085, 0.180, 0.480},
                    {0.129, 0.400, 0.674},
                    {0.262, 0.576, 0.765},
                    {0.572, 0.772, 0.871},
                    {0.820, 0.898, 0.941},
                    {0.955, 0.955, 0.945},
                    {0.992, 0.859, 0.780},
                    {0.957, 0.647, 0.510},
                    {0.839, 0.376, 0.302},
                    {0.698, 0.094, 0.168},
                    {0.430, 0.020, 0.130}},
                   white);
}

ColourMap ColourMap::sequential() {
  return ColourMap({{0.267, 0.005, 0.329},
                    {0.283, 0.141, 0.458},
                    {0.254, 0.265, 0.530},
                    {0.207, 0.372, 0.553},
                    {0.164, 0.471, 0.558},
                    {0.128, 0.567, 0.551},
                    {0.135, 0.659, 0.518},
                    {0.267, 0.749, 0.441},
                    {0.478, 0.821, 0.318},
                    {0.741, 0.873, 0.150},
                    {0.993, 0.906, 0.144}});
}

Colour ColourMap::at(double fraction) const {
  const double place = std::clamp(fraction, 0.0, 1.0);
  const double share = place < middle_ ? 0.5 * place / middle_ : 0.5 + 0.5 * (place - middle_) / (1.0 - middle_);
  const double position = share * static_cast<double>(nodes_.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(position), nodes_.size() - 2);
  const double t = position - static_cast<double>(i);
  Colour colour{};
  for (int c = 0; c < 3; ++c) colour[c] = (1.0 - t) * nodes_[i][c] + t * nodes_[i + 1][c];
  return colour;
}

}  // namespace vehd
