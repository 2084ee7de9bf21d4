#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/frame.hpp"

namespace vehd {

/// Where two vesicles, or a vesicle and a wall, are nearest to each other.
struct SmallestGap {
  double distance = std::numeric_limits<double>::infinity();  ///< infinite for a single vesicle in unbounded fluid
  double relative = std::numeric_limits<double>::infinity();  ///< over the smaller of both radii √(A/4π)
  double radius = 0.0;                                        ///< the smaller one
  std::size_t first = 0, second = 0;                          ///< indices of both; equal for a gap to a wall
  Vector3 place = Vector3::Zero();                            ///< midpoint of the gap
  bool to_wall = false;                                       ///< the second is a wall
  /// Of each vesicle: degree that its densities in all gaps to neighbours and wall require,
  /// degrees_of_gap/√(gap over radius), the gap to a wall being half of that to the image; 0 without neighbours.
  std::vector<double> degrees{};

  [[nodiscard]] double degree() const;  ///< the largest of the degrees; 0 for a single vesicle in unbounded fluid
};

/// The smallest gap between the vesicles of a state, or between one and the wall, and the degrees of all gaps.
/// @param discretisation  of the state
/// @param tolerance       of the run; 0 with a fixed degree
/// Accuracy: that of nearest_points and nearest_to_wall
SmallestGap find_smallest_gap(const State& state, const Discretisation& discretisation, const std::optional<Wall>& wall,
                              double tolerance);

/// Rejects a step that brings two vesicles, or one and a wall, into contact, or so much nearer at once that they could
/// have passed through each other.
/// @throws ConvergenceError naming both, the place and the distance
/// @param before   at the start of the step; infinite at the start of a run
/// @param spacing  of the grids, over the radius
/// @param frame    of the state: messages give places in the laboratory
/// @param names    of the vesicles, or empty
void require_gap(const SmallestGap& gap, const SmallestGap& before, double spacing, const Frame& frame,
                 const std::vector<std::string>& names);

}  // namespace vehd
