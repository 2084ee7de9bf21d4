#pragma once

#include <cstddef>
#include <vector>

#include "bie/support/types.hpp"

/// Distance and arrangement of closed membranes.
namespace vehd {

/// The points of two membranes that are nearest to each other.
struct NearestPoints {
  Vector3 on_first = Vector3::Zero(), on_second = Vector3::Zero();
  /// Their distance; negative if the second point is inside the first membrane.
  double gap = 0.0;
};

/// Nearest points by Newton's method for both at once, from the nearest pair of nodes.
/// @param first, second  coefficients of x, [n_coefficients x 3] each
/// Accuracy: rounding if the nearest pair of nodes is next to the nearest points; prolates and spheres at gaps from
/// 1e-6 to 10 to 1e-12 (tests/potentials/nearest_points_test.cpp)
NearestPoints nearest_points(const Matrix& first, const Matrix& second);

/// Two of several membranes.
struct ClosePair {
  std::size_t first = 0, second = 0;  ///< their indices
  NearestPoints points;
};

/// The pairs with a gap of at most `reach`, and the closest pair whatever its gap; balls about the membranes exclude
/// distant ones.
/// @param membranes  coefficients of x of each, [n_coefficients x 3]
/// @return the closest pair first; empty for less than two membranes
std::vector<ClosePair> close_pairs(const std::vector<Matrix>& membranes, double reach);

/// Position of two membranes relative to each other.
enum class Arrangement { apart, intersecting, first_is_inside, second_is_inside };

/// Arrangement from the nodes of both membranes; membranes that touch to rounding count as meeting.
/// @param first, second  coefficients of x, [n_coefficients x 3] each
/// @throws ConvergenceError if a nearest point is not found
Arrangement arrangement_of(const Matrix& first, const Matrix& second);

}  // namespace vehd
