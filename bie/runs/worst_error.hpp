#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bie/runs/history.hpp"

namespace vehd {

/// Scale of the errors of a column: its largest magnitude, a radian for an angle. 0 where they do not count: of
/// all but shape, energy, tension and potentials, and of what vanishes by symmetry.
double size_of_column(const HistoryTable& history, const std::string& name);

/// The largest of the estimated errors, each over the largest value of its column; of angles over a radian. Counts
/// shape, energy, tension and potentials, but for what vanishes by symmetry.
/// @param errors  history_error.csv, which may have fewer rows than the history
/// @return  rows that have errors; where there are any also worst, column, time and a text of them
nlohmann::json worst_error(const HistoryTable& history, const HistoryTable& errors);

}  // namespace vehd
