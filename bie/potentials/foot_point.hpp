#pragma once

#include <vector>

#include "bie/potentials/graded_rule.hpp"
#include "bie/potentials/smooth_grid.hpp"
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

/// The foot point by Newton's method on the sphere from a starting direction: steps along great circles in local
/// frames, so that poles are ordinary points, each halved until it reduces the distance or the gradient.
/// @param position  coefficients of the surface, [n_coefficients x 3]
/// @param start     unit vector of the parametrisation near the foot point
/// @param target    x, on either side or on the surface, at any distance
/// @throws ConvergenceError after too many steps
/// Accuracy: rounding; feet to 1e-12 and heights to 1e-14 for |height| from 1e-7 to 0.1 on a shape of size 1
/// (tests/potentials/foot_point_test.cpp)
FootPoint find_foot_point(const Matrix& position, const Vector3& start, const Vector3& target);

/// Foot points of many targets, iterated together, in a third of the time of find_foot_point.
/// @param position  coefficients of the surface, [n_coefficients x 3]
/// @param starts   [n x 3]
/// @param targets  [n x 3]
/// @throws ConvergenceError naming the first target that needs too many steps
std::vector<FootPoint> find_foot_points(const Matrix& position, const Matrix& starts, const Matrix& targets);

/// Choice of the graded rules for a target near a membrane; targets with equal choices share their tables.
struct NearRule {
  int level = 0;    ///< grading scale 2^−level
  int azimuth = 0;  ///< azimuthal nodes start at kNodeGrowth^azimuth times the least

  auto operator<=>(const NearRule&) const = default;
};

/// The rule for a target with this foot point.
/// @param order        degree p of surface and densities
/// @param tolerance    of the rules, relative
/// @param on_membrane  the target is on the membrane, so that no distance needs to be resolved
/// Source: Johnston and Elliott 2005 for the grading; error of the trapezoidal rule along circles about the foot point,
/// Trefethen and Weideman 2014
NearRule near_rule(const FootPoint& foot, int order, double tolerance, bool on_membrane);

/// Graded rule for a choice; each stage has a quarter more nodes in either direction than the one before.
/// @param stage  ≥ 0
GradedRule make_near_rule(int order, const NearRule& choice, int stage);

/// Nearest points of the membrane, searched from the nearest nodes of a grid (NearestNodes).
/// @param position  coefficients of the membrane, [n_coefficients x 3]
/// @param nearest   of each target
/// @param targets   [n x 3]
/// @throws ConvergenceError if one is not found
std::vector<FootPoint> nearest_feet(const Matrix& position, const SmoothGrid& grid,
                                    const std::vector<NearestNodes>& nearest, const Matrix& targets);

}  // namespace vehd
