#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace vehd {

/// SI unit of the numbers of a file: number * scale is in this unit. "1" and 1 for pure numbers, and for all numbers if
/// no SI unit is given.
struct SiUnit {
  std::string symbol = "1";
  double scale = 1.0;
};

/// SI unit of a dimension given by its name, such as "force/area".
using SiUnits = std::function<SiUnit(std::string_view dimension)>;

}  // namespace vehd
