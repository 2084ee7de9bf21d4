#pragma once

#include <string>
#include <vector>

#include "bie/bench/picture.hpp"
#include "bie/bench/record.hpp"

namespace vehd {

/// What the picture of a bench shows of its first table; empty where there is nothing to draw.
/// @param bench  name of the bench: of its files
/// @throws InputError if the record lacks a column
std::vector<BenchPanel> panels_of(const std::string& bench, const BenchRecord& record);

}  // namespace vehd
