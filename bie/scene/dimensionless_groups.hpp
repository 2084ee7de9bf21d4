#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd {

/// One number by which scenes are compared: lengths and times in the scales of the scene, all others independent of
/// them.
struct DimensionlessGroup {
  std::string_view name;
  std::string_view symbol;
  double value = 0.0;
  std::string_view unit;  ///< "1", or the dimension of a length or time in the scene's own scale
  std::string_view meaning;
};

/// The groups that the effects of the scene define, geometry first. Built from the initial shape, which a shape of
/// kind "file" reads.
/// @throws InputError if the shape file cannot be used
std::vector<DimensionlessGroup> dimensionless_groups(const Scene& scene);

/// The value with its SI unit, "0.012 s"; empty for pure numbers and where the scene does not give the scale.
std::string si_text(const Scene& scene, const DimensionlessGroup& group);

}  // namespace vehd
