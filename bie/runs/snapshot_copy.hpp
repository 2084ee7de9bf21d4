#pragma once

#include <cstdint>

#include "bie/files/run_file.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// Copies a snapshot of one run.h5 under its number into another of at least the same degree: the same coefficients,
/// continued by zeros, on the grid of the target.
/// @param transform  between the degree and the grid of the target
/// @param si_units  of both files
/// @return the checksum of its seal
/// @throws InputError if its coefficients are not those of a run
std::int64_t copy_snapshot(Hdf5Writer& target, const RunReader& source, std::size_t number,
                           const SphereTransform& transform, const SiUnits& si_units);

}  // namespace vehd
