#pragma once

#include <cstddef>

#include "bie/files/run_reader.hpp"

namespace vehd {

/// Compares what a run.h5 holds for its readers with the coefficients that it follows from: fields of a snapshot on the
/// grid and on the closed surface, area elements, grids and weights, triangles, units and scales. A seal tells what was
/// altered after the run; this tells what the run itself wrote wrongly.
/// @param snapshot  number of one
/// @throws InputError naming the first dataset that does not follow
/// Accuracy: to the rounding of the sums from coefficients to values
void require_copies(const RunReader& run, std::size_t snapshot);

}  // namespace vehd
