#pragma once

#include <array>
#include <vector>

namespace vehd {

using Colour = std::array<double, 3>;  ///< red, green, blue in 0 ... 1 as displayed (sRGB)

/// Piecewise linear colours over 0 ... 1.
class ColourMap {
 public:
  /// Blue over white to red, for values of both signs.
  static ColourMap diverging();
  /// Dark blue over green to yellow, of even perceived steps.
  static ColourMap sequential();

  [[nodiscard]] Colour at(double fraction) const;

 private:
  explicit ColourMap(std::vector<Colour> nodes) : nodes_(std::move(nodes)) {}
  std::vector<Colour> nodes_;
};

}  // namespace vehd
