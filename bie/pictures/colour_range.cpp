#include "bie/pictures/colour_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

/// The least but for so many.
double least_but(std::vector<double> values, std::size_t n_beyond) {
  std::ranges::sort(values);
  return values[n_beyond];
}

}  // namespace

FieldReach reach_of(const Vector& values, const Vector& weights) {
  constexpr double left_out = 0.005, near = 0.25;
  std::vector<std::pair<double, double>> sorted;
  double total = 0.0;
  for (Index i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    sorted.emplace_back(values[i], weights[i]);
    total += weights[i];
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (sorted.empty()) return {none, none, none, none};
  std::ranges::sort(sorted);
  FieldReach reach{sorted.front().first, sorted.back().first, quantile(sorted, total, left_out),
                   quantile(sorted, total, 1.0 - left_out)};
  const double width = reach.upper - reach.lower;
  if (reach.lower - reach.least <= near * width) reach.lower = reach.least;
  if (reach.most - reach.upper <= near * width) reach.upper = reach.most;
  return reach;
}

ColourRange robust_range(const std::vector<FieldReach>& shapes, bool sign_matters) {
  constexpr double times_beyond = 0.05;
  // Where one sign is hardly there, its colours would be lost.
  constexpr double other_sign = 0.1;
  constexpr double rounding = 1e-9;
  std::vector<double> lower, upper;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const FieldReach& shape : shapes) {
    if (std::isnan(shape.lower)) continue;
    lower.push_back(shape.lower);
    upper.push_back(-shape.upper);
    least = std::min(least, shape.least);
    most = std::max(most, shape.most);
  }
  if (lower.empty()) return {-1.0, 1.0, true};
  const auto n_beyond = static_cast<std::size_t>(times_beyond * static_cast<double>(lower.size()));
  ColourRange range{least_but(lower, n_beyond), -least_but(upper, n_beyond)};
  const double magnitude = std::max(std::abs(range.lower), std::abs(range.upper));
  if (magnitude == 0.0) return {-1.0, 1.0, true};
  range.both_signs = sign_matters || (range.lower < 0.0 && range.upper > 0.0 &&
                                      std::min(-range.lower, range.upper) >= other_sign * magnitude);
  if (range.both_signs) {
    range.upper = magnitude;
    range.lower = -magnitude;
  } else if (range.upper - range.lower <= rounding * magnitude) {
    // A field that is constant up to rounding has no scale of its own.
    range.lower -= magnitude;
    range.upper += magnitude;
  }
  range.below = least < range.lower;
  range.above = most > range.upper;
  return range;
}

}  // namespace vehd
