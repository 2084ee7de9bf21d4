#include "bie/scene/accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "bie/scene/scene.hpp"
#include "bie/sphere/degrees.hpp"
#include "bie/stepping/time/time_rule.hpp"

namespace vehd {

int default_order(double tolerance) {
  // Harmonics of a membrane gain a digit every eight degrees or fewer; the run itself finds the degree that a state
  // needs.
  constexpr double kDegreesPerDigit = 8.0;
  return std::min(highest_order, static_cast<int>(std::ceil(kDegreesPerDigit * (1.0 - std::log10(tolerance)))));
}

Scene at_tolerance(Scene scene, double tolerance) {
  if (!scene.numerics.tolerance) scene.numerics.dt.reset();
  scene.numerics.tolerance = tolerance;
  scene.numerics.order = default_order(tolerance);
  scene.numerics.time_order = highest_time_order;
  return scene;
}

}  // namespace vehd
