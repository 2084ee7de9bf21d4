#pragma once

#include <cstddef>
#include <vector>

#include "bie/support/types.hpp"

/// How two closed membranes lie to each other.
namespace vehd {

/// The points of two membranes that are nearest to each other.
struct NearestPoints {
  Vector3 on_first = Vector3::Zero(), on_second = Vector3::Zero();
  /// Their distance; negative where the second point is behind the first membrane.
  double gap = 0.0;
};

/// Newton's method for both points at once, from the nearest pair of nodes.
/// @param first, second  coefficients of x, [n_coefficients x 3] each
/// Accuracy: rounding where the nearest pair of nodes is next to the nearest points; prolates and spheres at gaps from
/// 1e-6 to 10 to 1e-12 (tests/potentials/nearest_points_test.cpp)
NearestPoints nearest_points(const Matrix& first, const Matrix& second);

/// The two of several membranes between which the gap is smallest.
struct ClosestPair {
  std::size_t first = 0, second = 0;  ///< their numbers
  NearestPoints points;
};

/// @param membranes  coefficients of x of each, at least two; pairs that are farther apart than the nearest are passed
///     over by the balls about them
ClosestPair closest_pair(const std::vector<Matrix>& membranes);

/// Which part of two membranes is within the other.
enum class Arrangement { apart, they_meet, first_is_inside, second_is_inside };

/// From the nodes of either. Membranes that touch, up to rounding, meet.
/// @throws ConvergenceError where a nearest point
/// is not found
Arrangement arrangement_of(const Matrix& first, const Matrix& second);

}  // namespace vehd
