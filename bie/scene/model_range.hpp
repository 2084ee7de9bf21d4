#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bie/scene/scene.hpp"

/// Where a scene or its run leaves the range of the model. The verdict judges the numbers of a run; this judges the
/// physics. Limits and their sources: docs/verdict.md.
namespace vehd {

/// One quantity beyond its limit, both in SI units or pure numbers.
struct ModelWarning {
  std::string name;
  double value = 0.0, limit = 0.0;
  std::string text;
};

/// Largest values of a run, in units of the scene.
struct LargestValues {
  double potential = 0.0;     ///< |V_m|
  double tension = 0.0;       ///< λ
  double mean_tension = 0.0;  ///< ∫λ dA/A
};

/// Everything that leaves the range, each name once, by the vesicle that is farthest beyond it. What needs SI units is
/// judged where the scene has them.
/// @param reached  by the run; absent: estimated from a sphere of the same area
/// @throws InputError if the shape file cannot be used
std::vector<ModelWarning> model_warnings(const Scene& scene, const std::optional<LargestValues>& reached = {});

}  // namespace vehd
