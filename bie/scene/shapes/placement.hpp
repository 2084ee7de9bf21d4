#pragma once

#include "bie/scene/scene.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/support/types.hpp"

/// Size, orientation and position of a shape, on position coefficients [n_coefficients x 3].
namespace vehd {

/// Three numbers of a scene as a vector.
inline Vector3 vector_of(const Triple& triple) { return {triple[0], triple[1], triple[2]}; }

/// Transform between degree p and a grid for sampling shapes, which are not polynomials of bounded degree: a grid this
/// much finer keeps aliasing below the truncation error.
SphereTransform shape_transform(int order);

/// Position coefficients, [n_coefficients x 3], of the shape that goes through point(i, θ, φ) at the nodes i of the
/// transform's grid.
template <typename Point>
Matrix position_through(const SphereTransform& transform, const Point& point) {
  const SphereGrid& grid = transform.grid();
  Matrix points(grid.n_points(), 3);
  for (Index i = 0; i < points.rows(); ++i) {
    points.row(i) = point(i, grid.theta(i / grid.n_phi), grid.phi(i % grid.n_phi)).transpose();
  }
  return transform.analyze(points);
}

/// The right-handed rotation, exact for quarter turns about the coordinate axes.
/// @param rotation  axis of any length but zero, angle in degrees
Matrix3 rotation_matrix(const AxisAngle& rotation);

/// The body rotated together with its parametrisation, R x(R⁻¹ s), [n_coefficients x 3]: a shape that is symmetric
/// about an axis then has coefficients that are symmetric about the rotated one.
Matrix rotated(const Matrix& position, const Matrix3& rotation);

/// A scalar field on the body, coefficients [n_coefficients], rotated with it.
Vector rotated_scalar(const Vector& field, const Matrix3& rotation);

/// The shape moved by a vector, [n_coefficients x 3].
Matrix shifted(Matrix position, const Triple& by);

/// Coefficients, [n_coefficients x n_fields], with zeros in place of rounding errors, because symmetries are detected
/// from the coefficients.
Matrix without_rounding(const Matrix& coefficients);

/// Area and volume of the shape by a quadrature that is fine enough for resolved shapes.
struct ShapeSize {
  double area = 0.0;
  double volume = 0.0;
};
/// @param position  coefficients, [n_coefficients x 3]
/// Accuracy: spectral
ShapeSize size_of(const Matrix& position);

/// Does a run treat this shape, [n_coefficients x 3], as a sphere?
bool is_sphere(const Matrix& position);

}  // namespace vehd
