#pragma once

#include <string>
#include <vector>

namespace vehd {

/// A tick of an axis.
struct SweepTick {
  double place = 0.0;  ///< 0 ... 1 of the axis
  std::string text;
};

/// One direction of a picture of a sweep.
struct SweepAxis {
  std::string label;
  std::vector<double> places;  ///< of the values, 0 ... 1 of the axis
  std::vector<SweepTick> ticks;
};

/// Of values of a key as its table shows them ("0.5", "10 kHz", "shear"). Numbers of one unit stand where they belong,
/// by their logarithms if asked for; anything else side by side.
SweepAxis axis_of_values(const std::string& key, const std::vector<std::string>& values, bool is_logarithmic);

/// The same for cells of one size, one for each value in their order. Many values with even steps, or even steps of
/// their logarithms, have ticks at round numbers.
SweepAxis axis_of_cells(const std::string& key, const std::vector<std::string>& values);

/// Of numbers with some room at both ends; NaN has no place.
SweepAxis axis_of_numbers(const std::string& label, const std::vector<double>& values);

}  // namespace vehd
