#include "bie/scene/output_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bie/scene/units.hpp"

namespace vehd {
namespace {

struct Prefix {
  std::string_view symbol;
  double times = 1.0;  ///< times/over is the factor of the prefix, a ratio of two exact numbers
  double over = 1.0;
};
constexpr std::array prefixes = {Prefix{"M", 1e6},     Prefix{"k", 1e3},    Prefix{""},           Prefix{"m", 1, 1e3},
                                 Prefix{"u", 1, 1e6},  Prefix{"n", 1, 1e9}, Prefix{"p", 1, 1e12}, Prefix{"f", 1, 1e15},
                                 Prefix{"a", 1, 1e18}, Prefix{"z", 1, 1e21}};

/// Power of the prefix in a unit: 2 for um^2; 0 for a unit that takes none, such as 1/s.
int prefix_power(std::string_view si_unit) {
  if (si_unit.starts_with('1')) return 0;
  if (si_unit == "m^2") return 2;
  return si_unit == "m^3" ? 3 : 1;
}

/// Symbol with the largest prefix for which the number is at least one, up to rounding.
std::string suitable_symbol(std::string_view si_unit, double magnitude) {
  const int power = prefix_power(si_unit);
  if (power == 0 || magnitude == 0.0) return std::string(si_unit);
  constexpr double rounding = 1e-9;
  const auto fits = [&](const Prefix& prefix) {
    return magnitude * std::pow(prefix.over, power) >= std::pow(prefix.times, power) * (1.0 - rounding);
  };
  const auto found = std::ranges::find_if(prefixes, fits);
  const Prefix& prefix = found == prefixes.end() ? prefixes.back() : *found;
  return fmt::format("{}{}", prefix.symbol, si_unit);
}

/// Converts a number from SI base units to the unit of a symbol; NaN if that is not the SI unit with a prefix.
double in_unit(double value, std::string_view si_unit, std::string_view symbol) {
  const int power = prefix_power(si_unit);
  for (const Prefix& prefix : prefixes) {
    if (power == 0 && !prefix.symbol.empty()) continue;
    if (symbol != fmt::format("{}{}", prefix.symbol, si_unit)) continue;
    return value * std::pow(prefix.over, power) / std::pow(prefix.times, power);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::string OutputUnit::text_of(double number) const {
  const std::string text = fmt::format("{:g}", number * factor);
  return is_si() ? text + " " + symbol : text;
}

OutputUnits::OutputUnits(const Scene& scene) : scales_(scene.units) {
  if (!scene.units || scene.output.units == ResultUnits::dimensionless) return;
  for (const Dimension& dimension : dimensions()) {
    const bool has_scale = std::isfinite(si_scale(scales_, dimension.name));
    if (has_scale && !dimension.result_unit.empty()) symbols_.emplace(dimension.name, dimension.result_unit);
  }
}

OutputUnits::OutputUnits(std::optional<UnitsScene> scales, std::map<std::string, std::string, std::less<>> symbols)
    : scales_(std::move(scales)), symbols_(std::move(symbols)) {}

OutputUnit OutputUnits::of(std::string_view dimension) const {
  const auto symbol = symbols_.find(dimension);
  const Dimension* known = find_dimension(dimension);
  if (symbol == symbols_.end() || known == nullptr) return {};
  const double factor = in_unit(si_scale(scales_, dimension), known->si_unit(), symbol->second);
  return std::isfinite(factor) ? OutputUnit{symbol->second, factor} : OutputUnit{};
}

std::string si_number(double value, std::string_view dimension, int digits) {
  const std::string_view si_unit = find_dimension(dimension)->si_unit();
  const std::string symbol = suitable_symbol(si_unit, std::abs(value));
  return fmt::format("{:.{}g} {}", in_unit(value, si_unit, symbol), digits, symbol);
}

std::string quantity_text(const std::optional<UnitsScene>& units, double value, std::string_view dimension) {
  const double si = value * si_scale(units, dimension);
  return std::isnan(si) ? fmt::format("{:g}", value) : si_number(si, dimension);
}

std::string printed_unit(std::string_view symbol) {
  std::string text(symbol);
  // In units of results only the prefix begins with u.
  if (text.starts_with('u')) text.replace(0, 1, "µ");
  for (const auto& [written, printed] :
       {std::pair<std::string_view, const char*>{"^2", "²"}, {"^3", "³"}, {"eps0", "ε₀"}}) {
    for (std::size_t at = text.find(written); at != std::string::npos; at = text.find(written)) {
      text.replace(at, written.size(), printed);
    }
  }
  return text;
}

std::string with_unit(std::string_view label, std::string_view symbol) {
  return symbol.empty() ? std::string(label) : fmt::format("{} ({})", label, printed_unit(symbol));
}

}  // namespace vehd
