#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bie/fit/data_table.hpp"
#include "bie/scene/scene.hpp"
#include "bie/scene/settings.hpp"

namespace vehd {

/// Name of the quantity whose data are radii r(φ) of sections, in place of a column of history.csv.
constexpr const char* contour_quantity = "contour";
/// Columns of such data.
constexpr const char *contour_angle = "phi_deg", *contour_radius = "r";
/// Column of standard deviations.
constexpr const char* deviation_column = "deviation";

/// Measured quantity of a vesicle, against time or against a key of its scene that is varied from run to run. Numbers
/// are in SI base units where the scene has [units], otherwise in those of the scene.
struct Measured {
  std::string quantity;           ///< a column of history.csv, or contour_quantity
  std::string dimension;          ///< of it, see units.hpp
  std::string unit;               ///< in which files have it; empty of a pure number
  double factor = 1.0;            ///< from a number in that unit
  std::string abscissa = "time";  ///< or "table.key"
  std::string abscissa_unit{};
  double abscissa_factor = 1.0;  ///< of a time

  [[nodiscard]] bool is_contour() const { return quantity == contour_quantity; }
  [[nodiscard]] bool is_against_time() const { return abscissa == "time"; }
  /// The column of the data, and its header in files.
  [[nodiscard]] std::string column() const { return is_contour() ? contour_radius : quantity; }
  [[nodiscard]] std::string header() const;
  /// Header of the abscissa in files.
  [[nodiscard]] std::string abscissa_header() const;
};

/// One number that was measured.
struct Datum {
  std::string at;          ///< the abscissa as it is written, without its unit
  double time = 0.0;       ///< where that is a time
  double angle_deg = 0.0;  ///< φ of a contour
  double value = 0.0;
  double deviation = 0.0;  ///< its standard deviation
};

/// The data that one run predicts: all of them against time, those of one value of a key.
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
/// @throws InputError "place: ..." if the history of the scene has no such column, or the contour would be of several
std::string dimension_of(const Scene& scene, const std::string& quantity, const std::string& place);

/// Factor from a unit to SI base units, or 1 in a scene without [units].
/// @throws InputError "place: ..." if it is no unit of the dimension
double unit_factor(const Scene& scene, const std::string& dimension, const std::string& unit, const std::string& place);

/// The runs that predict the data: one against time, one for each value of a key.
std::vector<DataOfRun> runs_of(const Measured& measured, const std::vector<Datum>& data);

/// Fills in data and runs from a file of data.
/// @param quantity   of the experiment; its place is that of messages about it
/// @param deviation  of every number, "2 mV", where the file has no column of them; empty: none is given
/// @throws InputError "file:line: ..."
void read_data(Experiment& experiment, const DataTable& table, const std::string& quantity, const std::string& place,
               const std::string& deviation);

/// The largest tolerance of a run.
constexpr double loosest_tolerance = 1e-2;
/// Error allowed to the runs of n data, in standard deviations of a datum: a tenth; of more than 25 data less, so
/// that the errors of all together stay below half of what χ changes by for one standard error.
double run_error_in_deviations(std::size_t n_data);

/// Tolerance of runs for an error of `run_error` times the smallest deviation, relative to the largest value.
double tolerance_for(const std::vector<Datum>& data, double run_error);

}  // namespace vehd
