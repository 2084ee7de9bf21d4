#include "bie/pictures/shown_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "bie/pictures/gnuplot.hpp"

namespace vehd {
namespace {

/// Replaces a hyphen by a minus sign.
std::string with_minus(std::string text) {
  if (text.starts_with('-')) text.replace(0, 1, "\u2212");
  return text;
}

int exponent_of(double value) { return value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value)))); }

/// Numbers outside this range are written with a power of ten.
constexpr double longest = 1e5, shortest = 1e-3;

/// A number with this many digits: "0.25", "1.56 × 10^{-5}".
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

}  // namespace

double round_below(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  constexpr double rounding = 1.0 + 1e-12;
  for (const double factor : {10.0, 5.0, 2.0}) {
    if (factor * power <= length * rounding) return factor * power;
  }
  return power;
}

std::pair<double, double> finite_range(const std::vector<double>& values) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return {least, most};
}

double room_around_constant(double least, double most) {
  constexpr double rounding = 1e-9;
  const double size = std::max(std::abs(least), std::abs(most));
  if (most - least > rounding * size) return 0.0;
  return size > 0.0 ? 0.1 * size : 1.0;
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

std::vector<std::string> power_texts(const std::vector<int>& powers) {
  constexpr std::array<std::string_view, 5> decimals{"0.1", "1", "10", "100", "1000"};
  const bool are_decimal = std::ranges::all_of(powers, [](int power) { return power >= -1 && power <= 3; });
  std::vector<std::string> texts;
  for (const int power : powers) {
    texts.push_back(are_decimal ? std::string(decimals[static_cast<std::size_t>(power + 1)])
                                : fmt::format("10^{{{}}}", power));
  }
  return texts;
}

ShownUnit shown_unit(const OutputUnits& units, std::string_view dimension) {
  const OutputUnit unit = units.of(dimension);
  if (unit.is_si()) return {unit.factor, printed_unit(unit.symbol)};
  const OutputUnit length = units.of("length");
  if (dimension == "1/length" && length.is_si()) return {1.0 / length.factor, "1/" + printed_unit(length.symbol)};
  return {};
}

namespace {

struct LabelRow {
  std::string_view name, label;
};

constexpr std::array key_rows = {LabelRow{"electric.conductivity_in", "conductivity inside σ_i"},
                                 LabelRow{"electric.conductivity_out", "conductivity outside σ_e"},
                                 LabelRow{"electric.field_magnitude", "field strength |E_∞|"},
                                 LabelRow{"electric.permittivity", "permittivity ε"},
                                 LabelRow{"electric.waveform.frequency", "frequency"},
                                 LabelRow{"flow.rate", "shear rate"},
                                 LabelRow{"fluid.viscosity", "viscosity μ_e"},
                                 LabelRow{"fluid.viscosity_ratio", "viscosity ratio μ_i/μ_e"},
                                 LabelRow{"membrane.bending_modulus", "bending modulus κ_B"},
                                 LabelRow{"membrane.capacitance", "capacitance C_m"},
                                 LabelRow{"membrane.conductance", "conductance G_m"},
                                 LabelRow{"shape.reduced_volume", "reduced volume"},
                                 LabelRow{"suspension.volume_fraction", "volume fraction"}};

constexpr std::array column_rows = {LabelRow{"aspect_ratio_field", "aspect ratio along the field"},
                                    LabelRow{"bending_energy_scaled", "bending energy ∫H² dA"},
                                    LabelRow{"effective_viscosity_intrinsic", "intrinsic viscosity [η]"},
                                    LabelRow{"inclination_deg", "inclination (degrees)"},
                                    LabelRow{"tension_integral", "tension ∫λ dA"},
                                    LabelRow{"Vm_max", "largest |V_m|"},
                                    LabelRow{"Vm_north", "V_m at the north pole"},
                                    LabelRow{"q_north", "q at the north pole"}};

template <std::size_t kRows>
std::string_view label_among(const std::array<LabelRow, kRows>& rows, std::string_view name) {
  const auto* const row = std::ranges::find(rows, name, &LabelRow::name);
  return row == rows.end() ? std::string_view{} : row->label;
}

}  // namespace

std::string key_label(std::string_view key) {
  const std::string_view label = label_among(key_rows, key);
  return label.empty() ? gnuplot_literal(std::string(key)) : std::string(label);
}

std::string column_title(std::string_view column) {
  std::string title(label_among(column_rows, column));
  if (title.empty()) {
    title = column;
    std::ranges::replace(title, '_', ' ');
  }
  return title;
}

}  // namespace vehd
