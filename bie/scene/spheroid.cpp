#include "bie/scene/spheroid.hpp"

#include <cmath>
#include <numbers>

#include "bie/scene/bisection.hpp"

namespace vehd {
namespace {

constexpr double largest_aspect = 100.0;

/// Area over 4π of the spheroid with the semi-axes 1, 1, c.
double relative_area(double c) {
  if (c == 1.0) return 1.0;
  const double shorter_over_longer = c > 1.0 ? 1.0 / c : c;
  const double eccentricity = std::sqrt((1.0 - shorter_over_longer) * (1.0 + shorter_over_longer));
  const double cap = c > 1.0 ? c * std::asin(eccentricity) : c * c * std::atanh(eccentricity);
  return 0.5 * (1.0 + cap / eccentricity);
}

/// V/(4π/3) over (A/4π)^{3/2}: the volume against that of the sphere with the same area.
double reduced_volume_of(double c) { return c / std::pow(relative_area(c), 1.5); }

Triple axes_of_unit_area(double c) {
  const double a = 1.0 / std::sqrt(relative_area(c));
  return {a, a, a * c};
}

}  // namespace

Triple prolate_axes(double reduced_volume) {
  // Near the sphere the volume is flat in c; only the exact sphere is left without an axis.
  if (reduced_volume == 1.0) return {1.0, 1.0, 1.0};
  return axes_of_unit_area(
      rising_zero([&](double c) { return reduced_volume - reduced_volume_of(c); }, 1.0, largest_aspect));
}

Triple oblate_axes(double reduced_volume) {
  if (reduced_volume == 1.0) return {1.0, 1.0, 1.0};
  return axes_of_unit_area(
      rising_zero([&](double c) { return reduced_volume_of(c) - reduced_volume; }, 1.0 / largest_aspect, 1.0));
}

}  // namespace vehd
