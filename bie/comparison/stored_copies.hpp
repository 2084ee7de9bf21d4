#pragma once

#include <cstddef>

#include "bie/files/run_reader.hpp"

namespace vehd {

/// Compares the data that a run.h5 stores for its readers with the coefficients from which they follow: fields of a
/// snapshot on the grid and on the closed surface, area elements, grids and weights, triangles, units and scales. A
/// seal detects changes made after the run; this detects data that the run itself wrote wrongly.
/// @param snapshot  number of the snapshot
/// @throws InputError naming the first dataset that differs
/// Accuracy: to the rounding of the sums from coefficients to values
void require_copies(const RunReader& run, std::size_t snapshot);

}  // namespace vehd
