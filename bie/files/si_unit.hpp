#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace vehd {

/// SI unit of the numbers of a file: number * scale is in the unit. "1" and 1 of pure numbers, and of all
/// numbers where nobody says.
struct SiUnit {
  std::string symbol = "1";
  double scale = 1.0;
};

/// That of a dimension by its name, as "force/area".
using SiUnits = std::function<SiUnit(std::string_view dimension)>;

}  // namespace vehd
