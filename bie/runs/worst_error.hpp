#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "bie/runs/history.hpp"

namespace vehd {

/// By what errors of a column are divided: by its largest value, those of an angle by a radian. 0 where they do not
/// count: of all but shape, energy, tension and potentials, and of what vanishes by symmetry.
/// @param largest  magnitude in the column of this name
double size_of_column(std::string_view name, const std::function<double(const std::string& name)>& largest);

/// The largest of the estimated errors, each over the largest value of its column; of angles over a radian. Counts
/// shape, energy, tension and potentials, but for what vanishes by symmetry.
/// @param errors  history_error.csv, which may have fewer rows than the history
/// @return  rows that have errors; where there are any also worst, column, time and a text of them
nlohmann::json worst_error(const HistoryTable& history, const HistoryTable& errors);

}  // namespace vehd
