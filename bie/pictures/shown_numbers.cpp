#include "bie/pictures/shown_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace vehd {
namespace {

/// The sign that stands before numbers in print.
std::string with_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "\u2212");
  return text;
}

int exponent_of(double value) { return value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value)))); }

/// Numbers beyond these are written with a power of ten.
constexpr double longest = 1e5, shortest = 1e-3;

}  // namespace

double round_below(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  constexpr double rounding = 1.0 + 1e-12;
  for (const double factor : {10.0, 5.0, 2.0}) {
    if (factor * power <= length * rounding) return factor * power;
  }
  return power;
}

std::vector<double> round_ticks(double lower, double upper, int least) {
  constexpr double rounding = 1e-9;
  for (double step = round_below(upper - lower);; step = round_below(0.99 * step)) {
    const double first = std::ceil(lower / step - rounding), last = std::floor(upper / step + rounding);
    if (last - first + 1.0 < least) continue;
    std::vector<double> ticks;
    for (double i = first; i <= last; ++i) ticks.push_back(i * step);
    return ticks;
  }
}

std::vector<std::string> tick_texts(const std::vector<double>& ticks, int& power) {
  double largest = 0.0;
  for (const double tick : ticks) largest = std::max(largest, std::abs(tick));
  power = largest >= longest || largest < 10.0 * shortest ? exponent_of(largest) : 0;
  const double unit = std::pow(10.0, power);
  const double step = ticks.size() > 1 ? (ticks[1] - ticks[0]) / unit : ticks.front() / unit;
  const int decimals = std::max(0, -exponent_of(step * (1.0 + 1e-9)));
  std::vector<std::string> texts;
  for (const double tick : ticks) texts.push_back(with_minus(fmt::format("{:.{}f}", tick / unit + 0.0, decimals)));
  return texts;
}

std::string number_text(double value, int digits) {
  if (value == 0.0) return "0";
  const double rounded = std::stod(fmt::format("{:.{}e}", value, digits - 1));
  const double size = std::abs(rounded);
  if (size < longest && size >= shortest) {
    return with_minus(fmt::format("{:.{}f}", rounded, std::max(0, digits - 1 - exponent_of(rounded))));
  }
  const int power = exponent_of(rounded);
  return with_minus(fmt::format("{:.{}f} × 10^{{{}}}", rounded / std::pow(10.0, power), digits - 1,
                                with_minus(std::to_string(power))));
}

std::vector<std::string> distinct_texts(const std::vector<double>& values) {
  constexpr int most_digits = 9;
  const std::size_t n_values = std::set<double>(values.begin(), values.end()).size();
  const auto texts = [&](int digits) {
    std::vector<std::string> result;
    for (const double value : values) {
      std::string text = number_text(value, digits);
      // 0.5 is 0.5, not 0.500.
      if (text.find('^') == std::string::npos && text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.ends_with('.')) text.pop_back();
      }
      result.push_back(std::move(text));
    }
    return result;
  };
  for (int digits = 3; digits < most_digits; ++digits) {
    std::vector<std::string> result = texts(digits);
    if (std::set<std::string>(result.begin(), result.end()).size() == n_values) return result;
  }
  return texts(most_digits);
}

ShownUnit shown_unit(const OutputUnits& units, std::string_view dimension) {
  const OutputUnit unit = units.of(dimension);
  if (unit.is_si()) return {unit.factor, printed_unit(unit.symbol)};
  const OutputUnit length = units.of("length");
  if (dimension == "1/length" && length.is_si()) return {1.0 / length.factor, "1/" + printed_unit(length.symbol)};
  return {};
}

}  // namespace vehd
