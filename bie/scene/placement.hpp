#pragma once

#include "bie/scene/scene.hpp"
#include "bie/support/types.hpp"

/// Size, direction and place of a shape, on position coefficients [n_coefficients x 3].
namespace vehd {

/// Right-handed; exact for quarter turns about the coordinate axes. The axis must not be zero.
/// @param rotation  axis of any length, angle in degrees
Matrix3 rotation_matrix(const AxisAngle& rotation);

/// The body rotated together with its parametrisation, R x(R⁻¹ s): a shape that is symmetric about an axis then has
/// coefficients that are symmetric about the rotated one.
Matrix rotated(const Matrix& position, const Matrix3& rotation);

/// A scalar field on the body, coefficients, rotated with it.
Vector rotated_scalar(const Vector& field, const Matrix3& rotation);

/// The shape moved by the vector.
Matrix shifted(Matrix position, const Triple& by);

/// Zero in place of coefficients that are nothing but rounding: symmetries are read off the coefficients.
Matrix without_rounding(const Matrix& coefficients);

/// Area and volume of the shape by a rule that is fine enough to be exact for resolved shapes.
struct ShapeSize {
  double area = 0.0;
  double volume = 0.0;
};
/// @param position  coefficients, [n_coefficients x 3]
/// Accuracy: spectral
ShapeSize size_of(const Matrix& position);

}  // namespace vehd
