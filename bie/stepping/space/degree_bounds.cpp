#include "bie/stepping/space/degree_bounds.hpp"

#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

Vector degree_bounds(const Matrix& coefficients) {
  const int order = order_of(coefficients.rows());
  Vector bounds(order + 1);
  for (int n = 0; n <= order; ++n) {
    const double norm = coefficients.middleRows(coefficient_index(n, -n), 2 * n + 1).norm();
    bounds[n] = norm * std::sqrt((2.0 * n + 1.0) / (4.0 * std::numbers::pi));
  }
  return bounds;
}

}  // namespace vehd
