#include "meshes/surface_samples.hpp"

#include <algorithm>
#include <numbers>

namespace vehd::meshes {

Eigen::Matrix3Xd surface_samples(const FrozenShape& shape) {
  const int n = std::max(48, 3 * shape.degree());
  Eigen::Matrix3Xd directions(3, (n + 1) * 2 * n);
  Eigen::Index column = 0;
  for (int j = 0; j <= n; ++j) {
    for (int k = 0; k < 2 * n; ++k) {
      directions.col(column++) = direction_of(std::numbers::pi * j / n, std::numbers::pi * k / n);
    }
  }
  return shape.positions(directions);
}

}  // namespace vehd::meshes
