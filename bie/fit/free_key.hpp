#pragma once

#include <string>

namespace vehd {

/// A key of a scene that a fit determines, as a number in one unit.
///
/// A fit varies a dimensionless coordinate p: the logarithm of the number if `is_logarithmic`, otherwise the number
/// over the width of its interval.
struct FreeKey {
  std::string name;  ///< "table.key"
  std::string unit;  ///< as written; empty for pure numbers and for scenes without [units]
  bool is_logarithmic = false;
  double from = 0.0, to = 1.0;  ///< from < to
  double start = 0.5;           ///< between them
  std::string place{};          ///< "file:line"

  /// p of a number in `unit`.
  [[nodiscard]] double coordinate_of(double number) const;
  /// The number in `unit` at p; the inverse of coordinate_of.
  [[nodiscard]] double number_of(double coordinate) const;
  /// "table.key=value", as for the option --set.
  [[nodiscard]] std::string setting_of(double number) const;
  /// Standard error of the number, to first order in that of the coordinate.
  [[nodiscard]] double error_of(double number, double error_of_coordinate) const;
};

}  // namespace vehd
