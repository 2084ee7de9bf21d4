#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd {

/// A characteristic number of a scene: a length or time in the scales of the scene, or a number that does not depend on
/// them.
struct DimensionlessGroup {
  std::string_view name;
  std::string_view symbol;
  double value = 0.0;
  std::string_view unit;  ///< "1", or the dimension "length" or "time"
  std::string_view meaning;
};

/// Groups that the effects of the scene define, geometry first. They use the initial shape, which is read from a file
/// for the kind "file".
/// @throws InputError if the shape file cannot be used
std::vector<DimensionlessGroup> dimensionless_groups(const Scene& scene);

/// The value with its SI unit, "0.012 s"; empty for pure numbers and if the scene does not give the scale.
std::string si_text(const Scene& scene, const DimensionlessGroup& group);

}  // namespace vehd
