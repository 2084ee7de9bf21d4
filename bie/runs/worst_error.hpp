#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bie/runs/history.hpp"

namespace vehd {

/// Scale of the errors of a column: its largest magnitude, or a radian for an angle. 0 for columns whose errors do not
/// count: all but shape, energy, tension and potentials, and those that vanish by symmetry.
double size_of_column(const HistoryTable& history, const std::string& name);

/// The largest estimated error relative to the largest value of its column, or to a radian for angles. Only shape,
/// energy, tension and potentials count, without columns that vanish by symmetry.
/// @param errors  history_error.csv, which may have fewer rows than the history
/// @return  number of rows with errors; if there are any, also worst, column, time and a text
nlohmann::json worst_error(const HistoryTable& history, const HistoryTable& errors);

}  // namespace vehd
