#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bie/scene/output_units.hpp"

/// Numbers as pictures show them: round ticks, few digits, units of the run.
namespace vehd {

/// The largest of 1, 2 and 5 times a power of ten that does not exceed a positive length.
double round_below(double length);

/// Least and greatest of the finite numbers; ∞ and −∞ if there are none.
std::pair<double, double> finite_range(const std::vector<double>& values);

/// Margin of an axis on either side of values that are constant up to rounding; 0 for other values.
double room_around_constant(double least, double most);

/// Multiples of the largest round step that yields at least `least` of them between the bounds; ascending.
std::vector<double> round_ticks(double lower, double upper, int least = 3);

/// One text for each number, all with the digits that their step needs; a common power of ten is left out and returned
/// in `power`.
std::vector<std::string> tick_texts(const std::vector<double>& ticks, int& power);

/// Texts with the fewest digits, at least three, that distinguish different numbers; trailing zeros are removed.
std::vector<std::string> distinct_texts(const std::vector<double>& values);

/// Texts of the ticks of a logarithmic axis at powers of ten: decimals if all are between 0.1 and 1000.
std::vector<std::string> power_texts(const std::vector<int>& powers);

/// Display of numbers of a scene: times `factor`, in `unit`.
struct ShownUnit {
  double factor = 1.0;
  std::string unit{};  ///< as printed; empty: dimensionless
};

/// Unit in which a run shows a dimension, given by its name in scene/units.hpp; curvatures follow the unit of length.
ShownUnit shown_unit(const OutputUnits& units, std::string_view dimension);

/// Words and symbol of a key of a scene, as enhanced text of gnuplot: "permittivity ε" for "electric.permittivity". The
/// key itself if it has none.
std::string key_label(std::string_view key);

/// Words and symbol of a column of history.csv without its unit; its name without underscores if it has none.
std::string column_title(std::string_view column);

}  // namespace vehd
