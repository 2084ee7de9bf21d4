#include "bie/pictures/view.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "bie/scene/model_of.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/sphere/principal_axes.hpp"
#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// View along a direction: z points upwards, or y if the view is along z.
/// @return rows: right, up, towards the eye; world coordinates become those of the picture
Matrix3 view_along(const Vector3& to_eye) {
  const Vector3 eye = to_eye.normalized();
  constexpr double steep = 0.99;
  const Vector3 upward = std::abs(eye.z()) > steep ? Vector3::UnitY() : Vector3::UnitZ();
  const Vector3 right = upward.cross(eye).normalized();
  Matrix3 frame;
  frame.row(0) = right;
  frame.row(1) = eye.cross(right);
  frame.row(2) = eye;
  return frame;
}

Matrix3 view_of_axis(int axis) {
  // Along y from the front, so that x points to the right.
  return view_along(axis == 1 ? Vector3(-Vector3::UnitY()) : Vector3(Vector3::Unit(axis)));
}

/// M such that a^T M a is the weight along the unit vector a of what the picture should show.
Matrix3 weights_of(const Scene& scene, const Matrix3& gyration) {
  Matrix3 weights = Matrix3::Zero();
  const auto add_direction = [&weights](const Vector3& direction) {
    if (direction.squaredNorm() > 0.0) weights += direction * direction.transpose() / direction.squaredNorm();
  };
  if (scene.electric) add_direction(vector_of(scene.electric->field));
  if (scene.gravity) add_direction(vector_of(scene.gravity->acceleration));
  const std::optional<BackgroundFlow> linear = model_of(scene).flow;
  if (scene.flow && !linear) add_direction(Vector3::UnitX());
  if (linear) {
    const Matrix3& gradient = linear->gradient;
    const double size = gradient.squaredNorm();
    if (size > 0.0) weights += (gradient * gradient.transpose() + gradient.transpose() * gradient) / size;
  }
  // The axis that differs most from the two others; its small weight decides only if nothing else does.
  const auto [moments, axes] = principal_axes(gyration);
  const bool prolate = moments[2] - moments[1] > moments[1] - moments[0];
  constexpr double share = 0.01;
  const double difference = prolate ? moments[2] - moments[1] : moments[1] - moments[0];
  if (moments.sum() > 0.0 && difference > 1e-6 * moments.sum()) {
    const Vector3 axis = axes.col(prolate ? 2 : 0);
    weights += share * axis * axis.transpose();
  }
  return weights;
}

}  // namespace

Matrix3 parse_view(const std::string& text) {
  constexpr std::array names{"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    if (text == names[static_cast<std::size_t>(axis)]) return view_of_axis(axis);
  }
  std::istringstream stream(text);
  Vector3 direction;
  char comma = ',';
  for (int i = 0; i < 3; ++i) {
    if (i > 0) stream >> comma;
    if (comma != ',' || !(stream >> direction[i])) stream.setstate(std::ios::failbit);
  }
  if (!stream || !(stream >> std::ws).eof() || !direction.allFinite() || direction.norm() == 0.0) {
    throw InputError(
        fmt::format("--view: \"{}\" is not a direction; accepted: x, y, z or three numbers, as 1,1,0.5", text));
  }
  return view_along(direction);
}

Matrix3 default_view(const Scene& scene, const Matrix3& gyration) {
  const Matrix3 weights = weights_of(scene, gyration);
  // Rounding errors must not decide among the axes.
  constexpr double rounding = 1e-6;
  int best = 1;
  for (const int axis : {2, 0}) {
    if (weights(axis, axis) < weights(best, best) - rounding) best = axis;
  }
  const PrincipalAxes axes = principal_axes(weights);
  constexpr double oblique = 0.02;
  if (weights(best, best) < oblique || axes.values[0] > 0.5 * weights(best, best)) return view_of_axis(best);
  Vector3 eye = axes.directions.col(0);
  // Seen from the front or from above.
  if (eye.y() > rounding || (std::abs(eye.y()) <= rounding && eye.z() < 0.0)) eye = -eye;
  return view_along(eye);
}

}  // namespace vehd
