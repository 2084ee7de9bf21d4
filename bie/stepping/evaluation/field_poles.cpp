#include "bie/stepping/evaluation/field_poles.hpp"

#include <limits>
#include <numbers>
#include <utility>

#include "bie/sphere/axis_crossing.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {
namespace {

double value_at(const SpherePoint& point, const Vector& field) {
  return evaluate_harmonics(field, Vector{{point.theta}}, Vector{{point.phi}})(0, 0);
}

SphereDerivatives rotated(const Matrix3& rotation, const SphereDerivatives& x) {
  const Matrix3 t = rotation.transpose();
  return {x.value * t, x.d1 * t, x.d2 * t, x.d11 * t, x.d12 * t, x.d22 * t};
}

}  // namespace

std::array<double, 2> values_at_poles(const Vector3& direction, const SphereTransform& fine, const Vector3& point,
                                      const Matrix& position, const Vector& field) {
  const bool axisymmetric = fine.azimuthal_order() < fine.order();
  if (axisymmetric) {
    const SpherePoint up = higher_pole(position);
    const double above = value_at(up, field), below = value_at({std::numbers::pi - up.theta, 0.0}, field);
    return direction.z() > 0.0 ? std::array{above, below} : std::array{below, above};
  }
  Matrix centred = position;
  centred.row(0).setZero();
  const SphereDerivatives x = fine.synthesize_hessian(centred);
  std::array<double, 2> values{};
  for (const std::size_t side : {0U, 1U}) {
    const Vector3 up = side == 0 ? direction : Vector3(-direction);
    // Of any turn about the line that brings it upwards.
    const Matrix3 rotation = Eigen::Quaterniond::FromTwoVectors(up, Vector3::UnitZ()).toRotationMatrix();
    const auto pole =
        highest_on_line(rotation * point, fine.grid(), rotated(rotation, x), centred * rotation.transpose());
    values[side] = pole ? value_at(*pole, field) : std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

}  // namespace vehd
