#pragma once

#include <string>
#include <vector>

#include "bie/bench/picture.hpp"
#include "bie/bench/record.hpp"

namespace vehd {

/// Panels of the picture of a bench's table; empty if there is nothing to draw.
/// @param bench  name of the table's file, see name_of_table
/// @throws InputError if the record lacks a column
std::vector<BenchPanel> panels_of(const std::string& bench, const BenchRecord& record);

}  // namespace vehd
