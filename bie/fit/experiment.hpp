#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bie/scene/scene.hpp"
#include "bie/scene/settings.hpp"
#include "bie/scene/units.hpp"
#include "bie/support/csv.hpp"

namespace vehd {

/// Quantity whose data are radii r(φ) of sections, instead of a column of history.csv.
constexpr const char* contour_quantity = "contour";
/// Columns of contour data.
constexpr const char *contour_angle = "phi_deg", *contour_radius = "r";
/// Column of standard deviations.
constexpr const char* deviation_column = "deviation";

/// Measured quantity of a vesicle, against time or against a key of its scene that is varied from run to run. Numbers
/// are in SI base units if the scene has [units], otherwise in those of the scene.
struct Measured {
  std::string quantity;           ///< a column of history.csv, or contour_quantity
  std::string dimension;          ///< of the quantity, see units.hpp
  std::string unit;               ///< in files; empty for a pure number
  double factor = 1.0;            ///< converts a number in that unit
  std::string abscissa = "time";  ///< or "table.key"
  std::string abscissa_unit{};
  double abscissa_factor = 1.0;  ///< converts a time

  [[nodiscard]] bool is_contour() const { return quantity == contour_quantity; }
  [[nodiscard]] bool is_against_time() const { return abscissa == "time"; }
  /// Name of the data column, and the same with its unit as in files.
  [[nodiscard]] std::string column() const { return is_contour() ? contour_radius : quantity; }
  [[nodiscard]] std::string header() const;
  /// Header of the abscissa in files.
  [[nodiscard]] std::string abscissa_header() const;
};

/// One measured number.
struct Datum {
  std::string at;          ///< the abscissa as written, without its unit
  double time = 0.0;       ///< if the abscissa is a time
  double angle_deg = 0.0;  ///< φ of a contour
  double value = 0.0;
  double deviation = 0.0;  ///< its standard deviation
};

/// Data that one run predicts: all of them against time, otherwise those for one value of the key.
struct DataOfRun {
  std::string setting{};  ///< "table.key=value"; empty against time
  std::vector<std::size_t> data;
};

/// A scene and its data.
struct Experiment {
  std::string name;
  SceneSource source;
  Scene scene;
  Measured measured;
  std::vector<Datum> data;
  std::vector<DataOfRun> runs{};
  double tolerance = 1e-3;  ///< of the runs
};

/// Dimension of a quantity.
/// @throws InputError "place: ..." if the history has no such column, or for a contour in a scene of several vesicles
std::string dimension_of(const Scene& scene, const std::string& quantity, const std::string& place);

/// Factor from a unit to SI base units, or 1 in a scene without [units].
/// @throws InputError "place: ..." if it is no unit of the dimension
double unit_factor(const Scene& scene, const std::string& dimension, const std::string& unit, const std::string& place);

/// The runs that predict the data: one against time, one for each value of a key.
std::vector<DataOfRun> runs_of(const Measured& measured, const std::vector<Datum>& data);

/// Fills in the measured quantity, the data and the runs from a table.
/// @param quantity   measured quantity; `place` is its "file:line" for messages
/// @param deviation  of every datum, if the file has no column of deviations
/// @throws InputError "file:line: ..."
void read_data(Experiment& experiment, const CsvTable& table, const std::string& quantity, const std::string& place,
               const std::optional<Quantity>& deviation);

/// The largest tolerance of a run.
constexpr double loosest_tolerance = 1e-2;
/// Allowed error of the runs for n data, in standard deviations of a datum: 0.1, or 0.5/√n for n > 25. The errors of
/// all data together then change χ by less than half of what one standard error does.
double run_error_in_deviations(std::size_t n_data);

/// Tolerance of runs for an error of `run_error` times the smallest deviation, relative to the largest value.
double tolerance_for(const std::vector<Datum>& data, double run_error);

}  // namespace vehd
