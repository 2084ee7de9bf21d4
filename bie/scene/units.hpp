#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bie/files/si_unit.hpp"
#include "bie/scene/scene.hpp"

/// Values with SI units: the units of each physical dimension, and the SI value of 1 of the scene. Four reference
/// scales (length, time, viscosity, potential) fix all others, including electric ones, because potential times charge
/// is an energy.
namespace vehd {

/// k_B in J/K, exact.
constexpr double boltzmann_constant = 1.380649e-23;

/// Accepted magnitudes of values: products of a few of them stay far from the limits of a double.
constexpr double smallest_magnitude = 1e-50, largest_magnitude = 1e50;

/// Is the value 0 or within these magnitudes?
inline bool has_magnitude_in_range(double value) {
  return value == 0.0 || (std::abs(value) >= smallest_magnitude && std::abs(value) <= largest_magnitude);
}

/// A unit as a ratio of two numbers, each exact, so that "10 um" is the number nearest to 1e-5.
struct Unit {
  std::string_view symbol;
  double times = 1.0;
  double over = 1.0;
  bool per_kelvin = false;  ///< unit of thermal energy: multiplied by the temperature
};

/// A physical dimension as powers of the reference scales, with the units that its values may have.
struct Dimension {
  std::string_view name;
  std::array<int, 4> powers;  ///< of the reference length, time, viscosity and potential
  std::vector<Unit> units;    ///< the first is the SI unit
  /// The unit of results, the same in every run; empty if no result has the dimension.
  std::string_view result_unit{};

  [[nodiscard]] std::string_view si_unit() const { return units.front().symbol; }
  /// Unit of that symbol, also without the spaces of a product, "mPas". @return nullptr if there is none
  [[nodiscard]] const Unit* find(std::string_view symbol) const;
  /// Symbols of its units.
  [[nodiscard]] std::vector<std::string_view> symbols() const;
  /// "m, mm, um, nm"
  [[nodiscard]] std::string accepted() const;
  /// "M L^3 T^-1", the reference scale of this dimension
  [[nodiscard]] std::string scale_text() const;
};

/// All dimensions of keys and results.
const std::vector<Dimension>& dimensions();

/// The dimension of that name, or nullptr.
const Dimension* find_dimension(std::string_view name);

/// A number and its unit, "1 kV/cm".
struct Quantity {
  double number = 0.0;
  std::string unit;       ///< in ASCII: u for micro, ^2 for a square, one space for a product
  std::string written{};  ///< the unit as in the text

  /// The number in SI base units.
  /// @param temperature  in K, for a unit that needs it; the result is NaN without it
  [[nodiscard]] double in_si(const Unit& of, std::optional<double> temperature = std::nullopt) const;
};

/// Number and unit of a text; nullopt if the text does not start with a finite number.
std::optional<Quantity> parse_quantity(std::string_view text);

/// SI value of 1 of the scene.
/// @return nullopt if a scale that the dimension needs is absent
std::optional<double> reference_scale(const UnitsScene& units, const Dimension& dimension);

/// SI value of 1 of a dimension by its name, 1 of a pure number ("1").
/// @return NaN if the scene does not determine it
double si_scale(const std::optional<UnitsScene>& units, std::string_view dimension);
/// SI unit and scale of each dimension, as files state them.
SiUnits si_units_of(const std::optional<UnitsScene>& units);

/// Factor from numbers of one scene to those of another: the ratio of their reference scales, 1 if neither has one.
/// @return nullopt if only one of them has the scale
std::optional<double> conversion(const std::optional<UnitsScene>& from, const std::optional<UnitsScene>& to,
                                 std::optional<double> UnitsScene::*scale);

/// Name in [units] of the first scale that the dimension needs and [units] lacks; empty if none is missing.
std::string_view missing_scale(const UnitsScene& units, const Dimension& dimension);

}  // namespace vehd
