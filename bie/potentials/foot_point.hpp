#pragma once

#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// The point y of the surface nearest to a target x.
struct FootPoint {
  double theta = 0.0, phi = 0.0;
  Vector3 position = Vector3::Zero();  ///< y
  Vector3 normal = Vector3::Zero();    ///< outward
  double area_element = 0.0;           ///< J
  double height = 0.0;                 ///< (x − y)·n, negative inside; |height| is the distance
  /// Roots of the eigenvalues of the Hessian of ½|x − y|² on the unit sphere: |x − y'| ≈ √(height² + (stretch t)²) at
  /// the angle t from the foot point.
  double smallest_stretch = 0.0, largest_stretch = 0.0;
};

/// Newton's method on the sphere from a starting direction: steps along great circles in local frames, so that poles
/// are no special points, each shortened until it brings the surface nearer.
/// @param position  coefficients of x, [n_coefficients x 3]
/// @param start     unit vector of the parametrisation near the foot point
/// @throws ConvergenceError after too many steps
/// @param target    x, on either side and at any distance, on the surface too
/// Accuracy: rounding; feet to 1e-12 and heights to 1e-14 for |height| from 1e-7 to 0.1 on a shape of size 1
/// (tests/potentials/foot_point_test.cpp)
FootPoint find_foot_point(const Matrix& position, const Vector3& start, const Vector3& target);

/// The same for many targets, which take their steps together: in a third of the time of one by one.
/// @param starts   [n x 3]
/// @param targets  [n x 3]
/// @throws ConvergenceError of the first of them that needs too many steps
std::vector<FootPoint> find_foot_points(const Matrix& position, const Matrix& starts, const Matrix& targets);

}  // namespace vehd
