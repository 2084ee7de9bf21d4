#pragma once

#include <cmath>

namespace vehd {

/// Zero of a function that rises through it once between lower and upper, to the last digit.
/// Accuracy: the last digit of a double
template <typename Function>
double rising_zero(const Function& function, double lower, double upper) {
  for (double middle = 0.5 * (lower + upper); middle > lower && middle < upper; middle = 0.5 * (lower + upper)) {
    (function(middle) < 0.0 ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper);
}

}  // namespace vehd
