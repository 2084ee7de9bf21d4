#pragma once

#include <array>
#include <vector>

namespace vehd {

using Colour = std::array<double, 3>;  ///< red, green, blue in 0 ... 1 as displayed (sRGB)

/// Piecewise linear colours over 0 ... 1.
class ColourMap {
 public:
  /// Blue over white to red, for values of both signs.
  /// @param white  place of the white, between 0 and 1
  static ColourMap diverging(double white = 0.5);
  /// Dark blue over green to yellow, of even perceived steps.
  static ColourMap sequential();

  [[nodiscard]] Colour at(double fraction) const;

 private:
  explicit ColourMap(std::vector<Colour> nodes, double middle = 0.5) : nodes_(std::move(nodes)), middle_(middle) {}
  std::vector<Colour> nodes_;
  double middle_;  ///< place of the middle node
};

}  // namespace vehd
