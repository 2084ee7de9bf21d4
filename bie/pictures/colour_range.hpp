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

/// Values with the area that each stands for.
struct WeightedValues {
  const Vector& values;
  const Vector& weights;
};

/// Between the values that leave out half a percent of the area at either end, so that one spot does not take the
/// colours from all others; as far as the extremes where these are near. Values of both signs have a range about zero.
/// A constant has a range about its value.
ColourRange robust_range(const std::vector<WeightedValues>& fields);

}  // namespace vehd
