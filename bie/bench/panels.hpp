#pragma once

#include <string>
#include <vector>

#include "bie/bench/picture.hpp"
#include "bie/bench/record.hpp"

namespace vehd {

/// What the picture of a table of a bench shows; empty where there is nothing to draw.
/// @param bench  name of the table's file, see name_of_table
/// @throws InputError if the record lacks a column
std::vector<BenchPanel> panels_of(const std::string& bench, const BenchRecord& record);

}  // namespace vehd
