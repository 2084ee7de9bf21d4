#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bie/scene/output_units.hpp"

/// Numbers as pictures show them: round ticks, few digits, the units of the run.
namespace vehd {

/// The largest of 1, 2 and 5 times a power of ten that is not above a positive length.
double round_below(double length);

/// Least and greatest of the finite numbers; infinity and its negative if there are none.
std::pair<double, double> finite_range(const std::vector<double>& values);

/// Room that an axis needs on either side of values that are constant up to rounding; 0 of others.
double room_around_constant(double least, double most);

/// Multiples of the largest round step that has at least `least` of them on a scale; ascending.
std::vector<double> round_ticks(double lower, double upper, int least = 3);

/// One text for each number, all with as many digits as their step needs; a power of ten that they share is left out
/// and given back by `power`.
std::vector<std::string> tick_texts(const std::vector<double>& ticks, int& power);

/// Texts of the same number of digits, as many as make different numbers differ, three at least.
std::vector<std::string> distinct_texts(const std::vector<double>& values);

/// How numbers of a scene are shown: times `factor`, in `unit`.
struct ShownUnit {
  double factor = 1.0;
  std::string unit{};  ///< as printed; empty: dimensionless
};

/// The unit in which a run shows a dimension, by its name in scene/units.hpp; curvatures go with lengths.
ShownUnit shown_unit(const OutputUnits& units, std::string_view dimension);

/// Words and symbol of a key of a scene, as enhanced text of gnuplot: "permittivity ε" for "electric.permittivity". The
/// key itself if it has none.
std::string key_label(std::string_view key);

/// Words and symbol of a column of history.csv without its unit; its name without underscores if it has none.
std::string column_title(std::string_view column);

}  // namespace vehd
