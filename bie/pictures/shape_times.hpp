#pragma once

#include <cstddef>
#include <vector>

#include "bie/files/run_reader.hpp"

namespace vehd {

/// Indices of at most `most` of n snapshots, evenly spread, the first and the last included.
std::vector<std::size_t> spread_evenly(std::size_t n, std::size_t most);

/// Indices between which the rows change by equal amounts, ascending, the first and the last included. Time counts for
/// a tenth of the change, so that a shape at rest is not left out.
/// @param rows  one for each time, [n_times x n_numbers]
std::vector<std::size_t> spread_by_change(const std::vector<double>& times, const Matrix& rows, std::size_t most);

/// At most `most` snapshots of a run, chosen by how much the shape changes.
std::vector<std::size_t> snapshots_by_change(const RunReader& run, std::size_t most);

}  // namespace vehd
