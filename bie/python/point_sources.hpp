#pragma once

#include <tuple>
#include <vector>

#include "bie/physics/point_sources.hpp"

namespace vehd::python {

/// Point sources as Python has them: place, strength, whether it is inside.
using GivenSources = std::vector<std::tuple<Vector3, double, bool>>;

inline std::vector<PointSource> sources_of(const GivenSources& given) {
  std::vector<PointSource> sources;
  for (const auto& [position, strength, inside] : given) sources.push_back({position, strength, inside});
  return sources;
}

}  // namespace vehd::python
