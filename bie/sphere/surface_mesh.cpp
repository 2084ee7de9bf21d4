#include "bie/sphere/surface_mesh.hpp"

#include <numbers>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

Matrix with_poles(const Matrix& grid_values, const Matrix& coefficients) {
  Matrix values(grid_values.rows() + 2, grid_values.cols());
  values.topRows(grid_values.rows()) = grid_values;
  values.bottomRows(2) = evaluate_harmonics(coefficients, Vector{{0.0, std::numbers::pi}}, Vector::Zero(2));
  return values;
}

std::vector<std::int64_t> closed_triangles(const SphereGrid& grid) {
  std::vector<std::int64_t> triangles;
  const auto add = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
    triangles.insert(triangles.end(), {a, b, c});
  };
  const auto point = [&](int j, int k) { return std::int64_t{j} * grid.n_phi + k % grid.n_phi; };
  const std::int64_t north = grid.n_points(), south = north + 1;
  for (int k = 0; k < grid.n_phi; ++k) {
    add(north, point(0, k), point(0, k + 1));
    for (int j = 0; j + 1 < grid.n_theta; ++j) {
      add(point(j, k), point(j + 1, k), point(j + 1, k + 1));
      add(point(j, k), point(j + 1, k + 1), point(j, k + 1));
    }
    add(south, point(grid.n_theta - 1, k + 1), point(grid.n_theta - 1, k));
  }
  return triangles;
}

}  // namespace vehd
