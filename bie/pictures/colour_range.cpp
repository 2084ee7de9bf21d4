#include "bie/pictures/colour_range.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vehd {
namespace {

/// The value below which this share of the weight is.
double quantile(const std::vector<std::pair<double, double>>& sorted, double total, double share) {
  double sum = 0.0;
  for (const auto& [value, weight] : sorted) {
    sum += weight;
    if (sum >= share * total) return value;
  }
  return sorted.back().first;
}

}  // namespace

ColourRange robust_range(const std::vector<WeightedValues>& fields) {
  std::vector<std::pair<double, double>> sorted;
  double total = 0.0;
  for (const WeightedValues& field : fields) {
    for (Index i = 0; i < field.values.size(); ++i) {
      if (!std::isfinite(field.values[i])) continue;
      sorted.emplace_back(field.values[i], field.weights[i]);
      total += field.weights[i];
    }
  }
  if (sorted.empty()) return {-1.0, 1.0, true};
  std::ranges::sort(sorted);
  const double least = sorted.front().first, most = sorted.back().first;

  constexpr double left_out = 0.005, near = 0.25;
  ColourRange range{quantile(sorted, total, left_out), quantile(sorted, total, 1.0 - left_out)};
  const double width = range.upper - range.lower;
  if (range.lower - least <= near * width) range.lower = least;
  if (most - range.upper <= near * width) range.upper = most;

  // A constant field, also one that is constant up to rounding, has no scale of its own.
  const double magnitude = std::max(std::abs(range.lower), std::abs(range.upper));
  constexpr double rounding = 1e-9, nothing = 1e-14;
  if (magnitude < nothing) return {-1.0, 1.0, true};
  if (range.upper - range.lower <= rounding * magnitude) return {range.lower - magnitude, range.upper + magnitude};

  // Where one sign is hardly there, its colours would be lost.
  constexpr double other_sign = 0.1;
  range.both_signs =
      range.lower < 0.0 && range.upper > 0.0 && std::min(-range.lower, range.upper) >= other_sign * magnitude;
  if (range.both_signs) {
    range.upper = magnitude;
    range.lower = -magnitude;
  }
  range.below = least < range.lower;
  range.above = most > range.upper;
  return range;
}

}  // namespace vehd
