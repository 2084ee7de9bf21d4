#pragma once

#include <Eigen/Core>

#include "meshes/harmonic_series.hpp"
#include "meshes/types.hpp"

namespace vehd::meshes {

/// A membrane at one instant, x(θ, φ) as a spherical-harmonic series. Immutable.
class FrozenShape {
 public:
  /// @param coefficients  [n_coefficients x 3], Cartesian components of x; outward orientation (x_θ × x_φ outwards)
  /// @throws std::invalid_argument if the sizes are inconsistent
  /// @throws MeshError if the enclosed volume is not positive: inside and outside would be exchanged
  explicit FrozenShape(const Eigen::MatrixXd& coefficients);

  [[nodiscard]] int degree() const { return series_.degree(); }
  [[nodiscard]] const HarmonicSeries& series() const { return series_; }

  /// x at one unit vector.
  [[nodiscard]] Point position(const Point& direction) const { return series_.value(direction); }
  /// x at many unit vectors, [3 x n_points] from [3 x n_points].
  [[nodiscard]] Eigen::Matrix3Xd positions(const Eigen::Matrix3Xd& directions) const {
    return series_.values(directions);
  }
  /// Derivative of x along the unit sphere: the matrix T with dx = T dr̂ for every tangential dr̂, and T r̂ = 0.
  [[nodiscard]] Matrix3 tangent_map(const Point& direction) const { return series_.gradient(direction); }
  /// n dA/dω: the outward normal times the area element J (dA = J dω on the unit sphere).
  [[nodiscard]] Point area_vector(const Point& direction) const;

  /// ∫ dA, ∫ x·n dA / 3 and the centroid of the enclosed volume, by Gauss–Legendre quadrature in cos θ and the
  /// trapezoidal rule in φ. Volume and centroid are exact to rounding, the area to the resolution of the shape.
  [[nodiscard]] double area() const { return area_; }
  [[nodiscard]] double volume() const { return volume_; }
  [[nodiscard]] const Point& centroid() const { return centroid_; }
  /// Radius of the sphere of equal area: the length scale of the shape.
  [[nodiscard]] double radius() const;
  /// Matrix M of the affine map r̂ → centre + M r̂ nearest to the shape in L2 of the unit sphere.
  [[nodiscard]] const Matrix3& affine_part() const { return affine_part_; }
  /// Largest distance of the surface from a point, over the quadrature grid.
  [[nodiscard]] double largest_distance(const Point& from) const;

 private:
  HarmonicSeries series_;
  double area_ = 0.0;
  double volume_ = 0.0;
  Point centroid_ = Point::Zero();
  Matrix3 affine_part_ = Matrix3::Zero();
};

}  // namespace vehd::meshes
