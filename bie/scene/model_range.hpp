#pragma once

#include <string>
#include <vector>

#include "bie/scene/scene.hpp"

/// Checks whether a scene or its run leaves the range of the model. The verdict concerns the numerics of a run, these
/// warnings its physics. Limits and their sources: docs/verdict.md.
namespace vehd {

/// One quantity beyond its limit, both in SI units or pure numbers.
struct ModelWarning {
  std::string name;
  double value = 0.0, limit = 0.0;
  std::string text;
};

/// What one vesicle reached in a run, in units of the scene.
struct ReachedValues {
  double potential = 0.0;                   ///< largest |V_m|
  double tension = 0.0;                     ///< largest λ
  double mean_tension = 0.0;                ///< largest ∫λ dA/A
  double least_mean_tension = 0.0;          ///< smallest ∫λ dA/A, at most 0
  double start_time = 0.0, end_time = 0.0;  ///< times of the first and the last row of the history
};

/// All quantities beyond their limits, each once, for the vesicle that exceeds the limit most. Limits in SI units are
/// checked only if the scene has [units].
/// @param reached  values of each vesicle in the run; empty: estimated from spheres of the same area
/// @throws InputError if the shape file cannot be used
std::vector<ModelWarning> model_warnings(const Scene& scene, const std::vector<ReachedValues>& reached = {});

}  // namespace vehd
