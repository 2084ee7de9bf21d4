#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace vehd {

/// What a timing holds for: processor, count of hardware threads, compiler, version, and the commit if the program
/// stands in a git work tree.
nlohmann::json machine_record();

/// Repeats of one timing.
struct Spread {
  double median = 0.0, min = 0.0, max = 0.0;
};
/// @param values  at least one
Spread spread_of(std::vector<double> values);

}  // namespace vehd
