#pragma once

#include <cstddef>
#include <vector>

#include "bie/files/run_reader.hpp"

namespace vehd {

/// Numbers of at most so many of n snapshots, evenly spread with the first and the last.
std::vector<std::size_t> spread_evenly(std::size_t n, std::size_t most);

/// Numbers of the entries between which the rows change by equal amounts, in ascending order, the first and the last
/// among them; a tenth of the way counts the time, so that a shape at rest is not left out.
/// @param rows  one for each time, [n_times x n_numbers]
std::vector<std::size_t> spread_by_change(const std::vector<double>& times, const Matrix& rows, std::size_t most);

/// At most so many snapshots of a run, chosen by how much the shape changes.
std::vector<std::size_t> snapshots_by_change(const RunReader& run, std::size_t most);

}  // namespace vehd
