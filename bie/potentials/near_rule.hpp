#pragma once

#include <vector>

#include "bie/potentials/foot_point.hpp"
#include "bie/potentials/graded_rule.hpp"
#include "bie/potentials/smooth_grid.hpp"

namespace vehd {

/// Which graded rules suit a target near a membrane; targets of equal choice share their tables.
struct NearRule {
  int level = 0;    ///< grading scale 2^−level
  int azimuth = 0;  ///< azimuthal nodes start at kNodeGrowth^azimuth times the least

  auto operator<=>(const NearRule&) const = default;
};

/// @param order      degree p of surface and densities
/// @param tolerance  of the rules
/// @param on_membrane  the target is there: no distance has to be resolved
/// Source: Johnston and Elliott 2005 for the grading; error of the trapezoidal rule along circles about the foot point,
/// Trefethen and Weideman 2014
NearRule near_rule(const FootPoint& foot, int order, double tolerance, bool on_membrane);

/// The rule of a choice; each stage has a quarter more nodes in either direction than the one before.
/// @param stage  ≥ 0
GradedRule make_near_rule(int order, const NearRule& choice, int stage);

/// The nearest points of the membrane, sought from the nearest nodes of a grid (NearestNodes).
/// @param position  coefficients of the membrane, [n_coefficients x 3]
/// @param nearest   of each target
/// @param targets   [n x 3]
/// @throws ConvergenceError if one is not found
std::vector<FootPoint> nearest_feet(const Matrix& position, const SmoothGrid& grid,
                                    const std::vector<NearestNodes>& nearest, const Matrix& targets);
/// That of one target.
FootPoint nearest_foot(const Matrix& position, const SmoothGrid& grid, const NearestNodes& nearest,
                       const Vector3& point);

}  // namespace vehd
