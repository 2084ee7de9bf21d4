#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bie/app/hdf5_writer.hpp"
#include "bie/scene/hdf5_reader.hpp"
#include "bie/scene/scene.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// Writes a snapshot of one run.h5 into another of at least its degree: the same coefficients, continued by zeros, on
/// the other grid. The source must be known to be intact.
/// @param transform  between degree and grid of the target
/// @param units  of the scene of both
/// @return its checksum
std::int64_t copy_snapshot(Hdf5Writer& target, const Hdf5Reader& source, const std::string& name,
                           const SphereTransform& transform, const std::optional<UnitsScene>& units);

}  // namespace vehd
