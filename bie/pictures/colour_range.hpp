#pragma once

#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// The values that the ends of a colour bar stand for.
struct ColourRange {
  double lower = 0.0, upper = 1.0;
  bool both_signs = false;            ///< zero is in the middle, and colours diverge from there
  bool below = false, above = false;  ///< values beyond the ends have the colours of the ends
};

/// How far the values of a field reach on one shape.
struct FieldReach {
  double least = 0.0, most = 0.0;
  /// The same without half a percent of the area at either end, so that one spot does not take the colours from all
  /// others; the extremes themselves where these are near.
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
