#include "bie/scene/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace vehd {
namespace {

constexpr std::array<std::string_view, 4> scale_names = {"length", "time", "viscosity", "potential"};
constexpr std::array<std::optional<double> UnitsScene::*, 4> scales = {&UnitsScene::length, &UnitsScene::time,
                                                                       &UnitsScene::viscosity, &UnitsScene::potential};
constexpr std::array<std::string_view, 4> scale_symbols = {"L", "T", "M", "Φ"};

/// Vacuum permittivity in F/m.
constexpr double vacuum_permittivity = 8.8541878188e-12;

std::string without_outer_spaces(std::string_view text) {
  const std::size_t start = text.find_first_not_of(' ');
  return start == std::string_view::npos ? "" : std::string(text.substr(start, text.find_last_not_of(' ') + 1 - start));
}

/// Normal form of the different spellings of a unit.
std::string plain_unit(std::string_view text) {
  constexpr std::array<std::array<std::string_view, 2>, 9> spellings = {
      {{"µ", "u"}, {"μ", "u"}, {"²", "^2"}, {"³", "^3"}, {"·", " "}, {"⋅", " "}, {".", " "}, {"*", " "}, {"\t", " "}}};
  std::string unit(text);
  for (const auto& [written, plain] : spellings) {
    for (std::size_t at = unit.find(written); at != std::string::npos; at = unit.find(written, at + plain.size())) {
      unit.replace(at, written.size(), plain);
    }
  }
  const auto both_spaces = [](char a, char b) { return a == ' ' && b == ' '; };
  unit.erase(std::unique(unit.begin(), unit.end(), both_spaces), unit.end());
  return without_outer_spaces(unit);
}

std::string without_spaces(std::string_view text) {
  std::string result(text);
  std::erase(result, ' ');
  return result;
}

}  // namespace

const Unit* Dimension::find(std::string_view symbol) const {
  const std::string wanted = without_spaces(symbol);
  const auto found = std::ranges::find(units, wanted, [](const Unit& unit) { return without_spaces(unit.symbol); });
  return found == units.end() ? nullptr : &*found;
}

std::vector<std::string_view> Dimension::symbols() const {
  std::vector<std::string_view> result;
  for (const Unit& unit : units) result.push_back(unit.symbol);
  return result;
}

std::string Dimension::accepted() const { return fmt::format("{}", fmt::join(symbols(), ", ")); }

std::string Dimension::scale_text() const {
  std::vector<std::string> factors;
  for (const std::size_t i : {2U, 0U, 1U, 3U}) {
    if (powers[i] == 0) continue;
    factors.push_back(powers[i] == 1 ? std::string(scale_symbols[i])
                                     : fmt::format("{}^{}", scale_symbols[i], powers[i]));
  }
  return factors.empty() ? "1" : fmt::format("{}", fmt::join(factors, " "));
}

const std::vector<Dimension>& dimensions() {
  static const std::vector<Dimension> all = {
      {"length", {1, 0, 0, 0}, {{"m"}, {"mm", 1, 1e3}, {"um", 1, 1e6}, {"nm", 1, 1e9}}, "um"},
      {"area", {2, 0, 0, 0}, {{"m^2"}, {"mm^2", 1, 1e6}, {"um^2", 1, 1e12}}, "um^2"},
      {"1/length", {-1, 0, 0, 0}, {{"1/m"}, {"1/mm", 1e3}, {"1/um", 1e6}}},
      {"time", {0, 1, 0, 0}, {{"s"}, {"ms", 1, 1e3}, {"us", 1, 1e6}, {"ns", 1, 1e9}}, "ms"},
      {"1/time", {0, -1, 0, 0}, {{"1/s"}, {"1/ms", 1e3}, {"Hz"}, {"kHz", 1e3}, {"MHz", 1e6}}, "1/s"},
      {"velocity", {1, -1, 0, 0}, {{"m/s"}, {"mm/s", 1, 1e3}, {"um/s", 1, 1e6}}, "um/s"},
      {"acceleration", {1, -2, 0, 0}, {{"m/s^2"}}},
      {"density", {-2, 1, 1, 0}, {{"kg/m^3"}, {"g/cm^3", 1e3}}},
      {"viscosity", {0, 0, 1, 0}, {{"Pa s"}, {"mPa s", 1, 1e3}, {"cP", 1, 1e3}}},
      {"energy", {3, -1, 1, 0}, {{"J"}, {"aJ", 1, 1e18}, {"zJ", 1, 1e21}, {"kBT", boltzmann_constant, 1, true}}, "fJ"},
      {"thermal energy", {3, -1, 1, 0}, {{"J"}, {"zJ", 1, 1e21}, {"K", boltzmann_constant}}},
      {"potential", {0, 0, 0, 1}, {{"V"}, {"mV", 1, 1e3}}, "mV"},
      {"field", {-1, 0, 0, 1}, {{"V/m"}, {"kV/m", 1e3}, {"V/cm", 1e2}, {"kV/cm", 1e5}}},
      {"conductivity", {2, -2, 1, -2}, {{"S/m"}, {"mS/m", 1, 1e3}, {"mS/cm", 1, 1e1}, {"uS/cm", 1, 1e4}}},
      {"permittivity", {2, -1, 1, -2}, {{"F/m"}, {"pF/m", 1, 1e12}, {"eps0", vacuum_permittivity}}},
      {"capacitance/area", {1, -1, 1, -2}, {{"F/m^2"}, {"mF/m^2", 1, 1e3}, {"uF/cm^2", 1, 1e2}}, "F/m^2"},
      {"conductance/area", {1, -2, 1, -2}, {{"S/m^2"}, {"S/cm^2", 1e4}, {"mS/cm^2", 1e1}}, "S/m^2"},
      {"current/area",
       {1, -2, 1, -1},
       {{"A/m^2"}, {"mA/m^2", 1, 1e3}, {"mA/cm^2", 1e1}, {"uA/cm^2", 1, 1e2}, {"nA/cm^2", 1, 1e5}},
       "A/m^2"},
      {"1/area", {-2, 0, 0, 0}, {{"1/m^2"}, {"1/um^2", 1e12}}, "1/m^2"},
      {"1/(area time)", {-2, -1, 0, 0}, {{"1/(m^2 s)"}, {"1/(um^2 us)", 1e18}}},
      {"temperature", {0, 0, 0, 0}, {{"K"}}},
      // Dimensions of results, with the names in run.h5; keys have only force/length of these.
      {"volume", {3, 0, 0, 0}, {{"m^3"}}, "um^3"},
      {"length^2", {2, 0, 0, 0}, {{"m^2"}}, "um^2"},
      {"force/area", {0, -1, 1, 0}, {{"Pa"}}, "Pa"},
      {"force/length",
       {1, -1, 1, 0},
       {{"N/m"},
        {"mN/m", 1, 1e3},
        {"uN/m", 1, 1e6},
        {"nN/m", 1, 1e9},
        {"J/m^2"},
        {"mJ/m^2", 1, 1e3},
        {"uJ/m^2", 1, 1e6}},
       "mN/m"},
      {"potential/length", {-1, 0, 0, 1}, {{"V/m"}}, "kV/m"},
      {"charge/area", {1, -1, 1, -1}, {{"C/m^2"}}},
      {"dipole", {4, -1, 1, -1}, {{"C m"}}, "zC m"},
      {"power", {3, -2, 1, 0}, {{"W"}}, "fW"},
      {"force", {2, -1, 1, 0}, {{"N"}}, "pN"},
  };
  return all;
}

const Dimension* find_dimension(std::string_view name) {
  const auto found = std::ranges::find(dimensions(), name, &Dimension::name);
  return found == dimensions().end() ? nullptr : &*found;
}

std::optional<Quantity> parse_quantity(std::string_view text) {
  const std::size_t start = text.find_first_not_of(' ');
  if (start == std::string_view::npos) return std::nullopt;
  const char* end = text.data() + text.size();
  Quantity quantity;
  const auto [rest, error] = std::from_chars(text.data() + start, end, quantity.number);
  if (error != std::errc() || !std::isfinite(quantity.number)) return std::nullopt;
  quantity.written = without_outer_spaces(std::string_view(rest, static_cast<std::size_t>(end - rest)));
  quantity.unit = plain_unit(quantity.written);
  return quantity;
}

double Quantity::in_si(const Unit& of, std::optional<double> temperature) const {
  const double value = number * of.times / of.over;
  return of.per_kelvin ? value * temperature.value_or(std::numeric_limits<double>::quiet_NaN()) : value;
}

std::optional<double> reference_scale(const UnitsScene& units, const Dimension& dimension) {
  if (!missing_scale(units, dimension).empty()) return std::nullopt;
  double scale = 1.0;
  for (std::size_t i = 0; i < dimension.powers.size(); ++i) {
    if (dimension.powers[i] != 0) scale *= std::pow(*(units.*scales[i]), dimension.powers[i]);
  }
  return scale;
}

double si_scale(const std::optional<UnitsScene>& units, std::string_view dimension) {
  if (dimension == "1") return 1.0;
  const Dimension* known = find_dimension(dimension);
  const auto scale = known != nullptr && units ? reference_scale(*units, *known) : std::nullopt;
  return scale.value_or(std::numeric_limits<double>::quiet_NaN());
}

SiUnits si_units_of(const std::optional<UnitsScene>& units) {
  return [units](std::string_view dimension) -> SiUnit {
    const Dimension* known = find_dimension(dimension);
    const double scale = si_scale(units, dimension);
    if (known == nullptr || !std::isfinite(scale)) return {};
    return {std::string(known->si_unit()), scale};
  };
}

std::optional<double> conversion(const std::optional<UnitsScene>& from, const std::optional<UnitsScene>& to,
                                 std::optional<double> UnitsScene::*scale) {
  const auto of = [scale](const std::optional<UnitsScene>& units) { return units ? *units.*scale : std::nullopt; };
  if (of(from).has_value() != of(to).has_value()) return std::nullopt;
  return of(from) ? *of(from) / *of(to) : 1.0;
}

std::string_view missing_scale(const UnitsScene& units, const Dimension& dimension) {
  for (std::size_t i = 0; i < dimension.powers.size(); ++i) {
    if (dimension.powers[i] != 0 && !(units.*scales[i])) return scale_names[i];
  }
  return {};
}

}  // namespace vehd
