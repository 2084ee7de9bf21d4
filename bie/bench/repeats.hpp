#pragma once

#include <cstdint>
#include <vector>

namespace vehd {

/// Repeats of one timing.
struct Spread {
  double median = 0.0, min = 0.0, max = 0.0;
  std::int64_t repeats = 0;
};
/// @param values  at least one
Spread spread_of(std::vector<double> values);

/// Whether a timing is to be repeated once more: not beyond the wanted number, and not where it has taken seconds
/// already, because it is long enough then.
bool wants_repeat(const std::vector<double>& seconds, int repeats);

/// Exponent b of y = a x^b, by least squares of the logarithms.
/// @param x, y  positive, at least two different x
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace vehd
