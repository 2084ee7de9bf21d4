#pragma once

#include <cstdint>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd {

/// What one accuracy costs.
struct MenuRow {
  double tolerance = 0.0;
  double order = 0.0;  ///< highest degree that the run takes
  double steps = 0.0;
  double seconds = 0.0;
  std::int64_t memory_bytes = 0;
  bool measured = false;  ///< by a whole run; otherwise carried on from those
};

/// Cost of a scene at the given tolerances, falling. The loosest ones are run to the end as long as the next one can be
/// expected to fit into the budget. The others follow from the last two: steps by a power law, degrees by a straight
/// line in the number of digits, seconds as steps times p³, memory as p⁴. Degree and time order of the scene are left
/// to each tolerance.
/// @param seconds  budget; the first run is made in any case
/// @throws ConvergenceError
std::vector<MenuRow> menu_of(const Scene& scene, const std::vector<double>& tolerances, double seconds);

}  // namespace vehd
