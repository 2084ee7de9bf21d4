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
  /// From blue over white to red, for values of both signs.
  /// @param white  position of white, between 0 and 1
  static ColourMap diverging(double white = 0.5);
  /// From dark blue over green to yellow, in even perceived steps.
  static ColourMap sequential();

  [[nodiscard]] Colour at(double fraction) const;

 private:
  explicit ColourMap(std::vector<Colour> nodes, double middle = 0.5) : nodes_(std::move(nodes)), middle_(middle) {}
  std::vector<Colour> nodes_;
  double middle_;  ///< position of the middle node
};

/// "#rrggbb".
std::string hex_of(const Colour& colour);

/// The values at the ends of a colour bar.
struct ColourRange {
  double lower = 0.0, upper = 1.0;
  bool both_signs = false;            ///< zero is in the middle, where the colours diverge
  bool below = false, above = false;  ///< some values lie beyond the ends, and have the colours of the ends
};

/// Range of the values of a field on one shape.
struct FieldReach {
  double least = 0.0, most = 0.0;
  /// The range without 0.5 % of the area at either end, so that one spot does not use up the colours; an end is the
  /// extreme itself if that is near.
  double lower = 0.0, upper = 0.0;
};

/// @param values   of the field, [n_points]
/// @param weights  area that each value represents, [n_points]
/// @return NaN if no value is finite
FieldReach reach_of(const Vector& values, const Vector& weights);

/// The range of all shapes. Of many shapes, a twentieth of the times at either end is left out: the values of the first
/// instants would otherwise leave no colours for the rest. Values of both signs get a range about zero, a constant
/// field one about its value.
/// @param sign_matters  colours diverge from zero even if all values have one sign
ColourRange robust_range(const std::vector<FieldReach>& shapes, bool sign_matters);

}  // namespace vehd
