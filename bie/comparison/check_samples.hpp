#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "bie/physics/wall.hpp"
#include "bie/potentials/layer_sums.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Points off the membrane at which φ and v are compared.
struct CheckSamples {
  Matrix points;      ///< [n_points x 3]
  Vector distance;    ///< from the membrane of the near ones; 0 for the others
  double near = 0.0;  ///< one grid spacing: nearer points count as near
};

/// Points within one grid spacing of the membrane on either side, and points further inside and outside; none beyond a
/// wall.
/// @param position  coefficients of the membrane, [n_coefficients x 3]
CheckSamples check_samples(const Matrix& position, const std::optional<Wall>& wall = {});

/// Values at points, [n_points x components], and the side of each.
using SampleValues = std::pair<Matrix, std::vector<Side>>;

/// Values at sample points, [n_points x components]: all in one call of `at`, or if that fails one by one, with NaN
/// where no value is found.
/// @param points     [n_points x 3]
/// @param is_inside  receives the side of each point
/// @param at         values at [n x 3] points; may throw ConvergenceError
Matrix where_possible(const Matrix& points, Index components, std::vector<bool>& is_inside,
                      const std::function<SampleValues(const Matrix&)>& at);

}  // namespace vehd
