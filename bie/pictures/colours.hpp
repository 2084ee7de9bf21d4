#pragma once

#include <array>
#include <string>
#include <vector>

#include "bie/support/types.hpp"

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

/// "#rrggbb".
std::string hex_of(const Colour& colour);

/// The values that the ends of a colour bar stand for.
struct ColourRange {
  double lower = 0.0, upper = 1.0;
  bool both_signs = false;            ///< zero is in the middle, and colours diverge from there
  bool below = false, above = false;  ///< values beyond the ends have the colours of the ends
};

/// Range of the values of a field on one shape.
struct FieldReach {
  double least = 0.0, most = 0.0;
  /// The range without half a percent of the area at either end, so that one spot does not use up the colours; the
  /// extremes themselves where these are near.
  double lower = 0.0, upper = 0.0;
};

/// @param weights  area that each value stands for
/// @return NaN where there is no number
FieldReach reach_of(const Vector& values, const Vector& weights);

/// The range of all shapes, of many but for a twentieth of the times at either end, for what a field does in its first
/// instants would leave no colours for the rest. Values of both signs have a range about zero, a constant one about its
/// value.
/// @param sign_matters  colours diverge from zero whatever the values
ColourRange robust_range(const std::vector<FieldReach>& shapes, bool sign_matters);

}  // namespace vehd
