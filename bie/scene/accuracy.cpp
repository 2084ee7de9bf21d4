#include "bie/scene/accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "bie/scene/scene.hpp"
#include "bie/sphere/degrees.hpp"
#include "bie/stepping/time/time_rule.hpp"

namespace vehd {

AccuracyDefaults accuracy_defaults(double tolerance) {
  // Harmonics of a membrane gain a digit every eight degrees or fewer; the degree that a state needs is found on the
  // way.
  constexpr double kDegreesPerDigit = 8.0;
  constexpr double kCoarse = 1e-4;
  const int order = static_cast<int>(std::ceil(kDegreesPerDigit * (1.0 - std::log10(tolerance))));
  return {std::min(highest_order, order), tolerance >= kCoarse ? highest_time_order - 1 : highest_time_order};
}

Scene at_tolerance(Scene scene, double tolerance) {
  const AccuracyDefaults defaults = accuracy_defaults(tolerance);
  if (!scene.numerics.tolerance) scene.numerics.dt.reset();
  scene.numerics.tolerance = tolerance;
  scene.numerics.order = defaults.order;
  scene.numerics.time_order = defaults.time_order;
  return scene;
}

}  // namespace vehd
