#include "bie/fit/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bie/runs/history.hpp"
#include "bie/scene/key_lookup.hpp"
#include "bie/scene/nearest_name.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/schema.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

std::string header(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
}

std::size_t column_of(const CsvTable& table, const std::string& name) {
  if (const auto found = table.find(name)) return *found;
  throw InputError(fmt::format("{}: has no column \"{}\"; {}", table.header_place(), name,
                               suggestion(name, {table.names().begin(), table.names().end()})));
}

/// The first column: time or a key of the scene.
void read_abscissa(Experiment& experiment, const CsvTable& table) {
  Measured& measured = experiment.measured;
  measured.abscissa = table.names().front();
  measured.abscissa_unit = table.unit(0);
  if (!measured.is_against_time()) {
    const KeyDescription& key =
        *keys_named(measured.abscissa, table.header_place(), "the first column, which is time or a key").front();
    unit_factor(experiment.scene, std::string(key.unit), measured.abscissa_unit, table.header_place());
    return;
  }
  measured.abscissa_factor = unit_factor(experiment.scene, "time", measured.abscissa_unit, table.header_place());
}

/// Standard deviations in SI base units, one for each row.
std::vector<double> deviations_in(const Experiment& experiment, const CsvTable& table,
                                  const std::optional<Quantity>& given) {
  const Measured& measured = experiment.measured;
  std::vector<double> deviations(table.n_rows());
  if (const auto column = table.find(deviation_column)) {
    if (given) {
      throw InputError(fmt::format("{}: has a column \"{}\", and the experiment a \"deviation\"; accepted: one of them",
                                   table.header_place(), deviation_column));
    }
    const double factor = unit_factor(experiment.scene, measured.dimension, table.unit(*column), table.header_place());
    for (std::size_t row = 0; row < deviations.size(); ++row) {
      deviations[row] = factor * table.number(row, *column);
      if (deviations[row] > 0.0) continue;
      throw InputError(fmt::format("{}: \"{}\" is {}; accepted: a number above 0", table.place(row), deviation_column,
                                   table.text(row, *column)));
    }
    return deviations;
  }
  if (!given) {
    throw InputError(
        fmt::format("{}: has no column \"{}\", and the experiment no \"deviation\"; accepted: the standard "
                    "deviation of the data in either",
                    table.header_place(), deviation_column));
  }
  std::ranges::fill(
      deviations, given->number * unit_factor(experiment.scene, measured.dimension, given->unit, table.header_place()));
  return deviations;
}

}  // namespace

std::string Measured::header() const { return vehd::header(column(), unit); }

std::string Measured::abscissa_header() const { return vehd::header(abscissa, abscissa_unit); }

std::string dimension_of(const Scene& scene, const std::string& quantity, const std::string& place) {
  if (quantity == contour_quantity && scene.vesicles.size() > 1) {
    throw InputError(fmt::format("{}: \"quantity\" is \"{}\", and the scene has {} vesicles; accepted: one", place,
                                 quantity, scene.vesicles.size()));
  }
  if (quantity == contour_quantity) return "length";
  if (quantity == "time") {
    throw InputError(fmt::format("{}: \"quantity\" is \"time\"; accepted: another column of history.csv", place));
  }
  const std::vector<HistoryColumn>& columns = history_columns(history_kind(scene));
  const auto found = std::ranges::find(columns, quantity, &HistoryColumn::name);
  if (found != columns.end()) return std::string(found->dimension);
  std::vector<std::string_view> names{contour_quantity};
  for (const HistoryColumn& column : columns) names.push_back(column.name);
  throw InputError(fmt::format("{}: \"quantity\" is \"{}\", which history.csv of the scene does not have; {}", place,
                               shortened(quantity), suggestion(quantity, names)));
}

double unit_factor(const Scene& scene, const std::string& dimension, const std::string& unit,
                   const std::string& place) {
  const Dimension* known = find_dimension(dimension);
  if (known == nullptr || !scene.units) {
    if (unit.empty()) return 1.0;
    throw InputError(fmt::format("{}: has the unit \"{}\"; accepted: none, of {}", place, shortened(unit),
                                 known == nullptr ? "a pure number" : "numbers of a scene without [units]"));
  }
  const auto quantity = parse_quantity("1 " + unit);
  if (const Unit* found = known->find(quantity ? quantity->unit : unit); found != nullptr && !unit.empty()) {
    if (found->per_kelvin && !scene.units->temperature) {
      throw InputError(
          fmt::format("{}: has the unit \"{}\", but the scene has no temperature; accepted: \"temperature\" in [units] "
                      "with the unit K",
                      place, unit));
    }
    return Quantity{1.0, ""}.in_si(*found, scene.units->temperature);
  }
  // Units of results have prefixes that values of a scene do not accept.
  const OutputUnit result = OutputUnits(scene.units, {{dimension, unit}}).of(dimension);
  if (result.is_si()) return si_scale(scene.units, dimension) / result.factor;
  throw InputError(fmt::format("{}: has {} for a {}; accepted: {}", place,
                               unit.empty() ? "no unit" : fmt::format("the unit \"{}\"", shortened(unit)), dimension,
                               known->accepted()));
}

std::vector<DataOfRun> runs_of(const Measured& measured, const std::vector<Datum>& data) {
  std::vector<DataOfRun> runs;
  for (std::size_t i = 0; i < data.size(); ++i) {
    std::string setting;
    if (!measured.is_against_time()) {
      const double number = parse_quantity(data[i].at)->number;
      setting = measured.abscissa_unit.empty()
                    ? fmt::format("{}={}", measured.abscissa, number)
                    : fmt::format("{}=\"{} {}\"", measured.abscissa, number, measured.abscissa_unit);
    }
    auto run = std::ranges::find(runs, setting, &DataOfRun::setting);
    if (run == runs.end()) run = runs.insert(runs.end(), DataOfRun{setting, {}});
    run->data.push_back(i);
  }
  return runs;
}

void read_data(Experiment& experiment, const CsvTable& table, const std::string& quantity, const std::string& place,
               const std::optional<Quantity>& deviation) {
  Measured& measured = experiment.measured;
  measured.quantity = quantity;
  measured.dimension = dimension_of(experiment.scene, quantity, place);
  const std::size_t values = column_of(table, measured.column());
  measured.unit = table.unit(values);
  measured.factor = unit_factor(experiment.scene, measured.dimension, measured.unit, table.header_place());
  read_abscissa(experiment, table);
  const std::vector<double> deviations = deviations_in(experiment, table, deviation);
  for (std::size_t row = 0; row < table.n_rows(); ++row) {
    Datum datum{
        .at = table.text(row, 0), .value = measured.factor * table.number(row, values), .deviation = deviations[row]};
    const double number = table.number(row, 0);
    if (measured.is_against_time()) {
      datum.time = measured.abscissa_factor * number;
      if (number < 0.0) {
        throw InputError(fmt::format("{}: \"time\" is {}; accepted: 0 or later", table.place(row), datum.at));
      }
    }
    if (measured.is_contour()) datum.angle_deg = table.number(row, column_of(table, contour_angle));
    experiment.data.push_back(std::move(datum));
  }
  experiment.runs = runs_of(measured, experiment.data);
  for (const DataOfRun& run : experiment.runs) {
    if (run.setting.empty()) continue;
    SceneSource source = experiment.source;
    source.settings.push_back(run.setting);
    try {
      static_cast<void>(read_scene(source));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", table.place(run.data.front()), error.what()));
    }
  }
}

double run_error_in_deviations(std::size_t n_data) {
  constexpr double most = 0.1, most_together = 0.5;
  return std::min(most, most_together / std::sqrt(static_cast<double>(n_data)));
}

double tolerance_for(const std::vector<Datum>& data, double run_error) {
  double largest = 0.0, least_deviation = std::numeric_limits<double>::infinity();
  for (const Datum& datum : data) {
    largest = std::max(largest, std::abs(datum.value));
    least_deviation = std::min(least_deviation, datum.deviation);
  }
  if (!(largest > 0.0)) return loosest_tolerance;
  return std::clamp(run_error * least_deviation / largest, tightest_tolerance, loosest_tolerance);
}

}  // namespace vehd
