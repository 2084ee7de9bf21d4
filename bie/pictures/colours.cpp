#include "bie/pictures/colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace vehd {

ColourMap ColourMap::diverging(double white) {
  return ColourMap({{0.085, 0.180, 0.480},
                    {0.129, 0.400, 0.674},
                    {0.262, 0.576, 0.765},
                    {0.572, 0.772, 0.871},
                    {0.820, 0.898, 0.941},
                    {0.955, 0.955, 0.945},
                    {0.992, 0.859, 0.780},
                    {0.957, 0.647, 0.510},
                    {0.839, 0.376, 0.302},
                    {0.698, 0.094, 0.168},
                    {0.430, 0.020, 0.130}},
                   white);
}

ColourMap ColourMap::sequential() {
  return ColourMap({{0.267, 0.005, 0.329},
                    {0.283, 0.141, 0.458},
                    {0.254, 0.265, 0.530},
                    {0.207, 0.372, 0.553},
                    {0.164, 0.471, 0.558},
                    {0.128, 0.567, 0.551},
                    {0.135, 0.659, 0.518},
                    {0.267, 0.749, 0.441},
                    {0.478, 0.821, 0.318},
                    {0.741, 0.873, 0.150},
                    {0.993, 0.906, 0.144}});
}

Colour ColourMap::at(double fraction) const {
  const double place = std::clamp(fraction, 0.0, 1.0);
  const double share = place < middle_ ? 0.5 * place / middle_ : 0.5 + 0.5 * (place - middle_) / (1.0 - middle_);
  const double position = share * static_cast<double>(nodes_.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(position), nodes_.size() - 2);
  const double t = position - static_cast<double>(i);
  Colour colour{};
  for (int c = 0; c < 3; ++c) colour[c] = (1.0 - t) * nodes_[i][c] + t * nodes_[i + 1][c];
  return colour;
}

std::string hex_of(const Colour& colour) {
  const auto byte = [](double c) { return static_cast<int>(std::lround(255.0 * c)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour[0]), byte(colour[1]), byte(colour[2]));
}

namespace {

/// The value below which this share of the weight lies.
double quantile(const std::vector<std::pair<double, double>>& sorted, double total, double share) {
  double sum = 0.0;
  for (const auto& [value, weight] : sorted) {
    sum += weight;
    if (sum >= share * total) return value;
  }
  return sorted.back().first;
}

/// The least value once n_beyond lower ones are left out.
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
  // If one sign is hardly present, its half of the diverging colours would be wasted.
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
