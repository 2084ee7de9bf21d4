#pragma once

#include <cstdint>
#include <string>

#include "bie/files/hdf5_reader.hpp"
#include "bie/files/run_file.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// Writes a snapshot of one run.h5 into another of at least its degree: the same coefficients, continued by zeros, on
/// the other grid. The source must be known to be intact.
/// @param transform  between degree and grid of the target
/// @param si_units  of both
/// @return its checksum
std::int64_t copy_snapshot(Hdf5Writer& target, const Hdf5Reader& source, const std::string& name,
                           const SphereTransform& transform, const SiUnits& si_units);

}  // namespace vehd
