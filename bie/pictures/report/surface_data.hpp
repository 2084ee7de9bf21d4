#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "bie/files/run_reader.hpp"
#include "bie/scene/output_units.hpp"

namespace vehd {

/// Snapshots for a page, evenly spread with the first and the last.
/// @param most  of them, at least 2; fewer are taken where the page would grow beyond 8 MB
/// @throws InputError if the run cannot be read
std::vector<std::size_t> snapshots_for_page(const RunReader& run, std::size_t most);

/// Shapes and fields at these snapshots: "times", "degrees", "position", "fields" (V_m, q, tension, those that the run
/// has), "radius" of a ball that holds all shapes, "extents" along the axes. The position is relative to its mean over
/// the parameter sphere.
/// @param units  that the numbers are in
/// @throws InputError if the run cannot be read
nlohmann::json surface_data(const RunReader& run, const std::vector<std::size_t>& snapshots, const OutputUnits& units);

}  // namespace vehd
