#pragma once

#include "bie/sphere/transform.hpp"

namespace vehd {

/// Between degree p and a grid to sample a shape on: shapes are no polynomials of bounded degree, and a grid this much
/// finer keeps aliasing below the truncation.
SphereTransform shape_transform(int order);

/// Position coefficients of the shape that goes through point(i, θ, φ) at the nodes i of the transform's grid.
template <typename Point>
Matrix position_through(const SphereTransform& transform, const Point& point) {
  const SphereGrid& grid = transform.grid();
  Matrix points(grid.n_points(), 3);
  for (Index j = 0; j < grid.n_theta; ++j) {
    for (Index k = 0; k < grid.n_phi; ++k) {
      const Index i = j * grid.n_phi + k;
      points.row(i) = point(i, grid.theta(j), grid.phi(k)).transpose();
    }
  }
  return transform.analyze(points);
}

}  // namespace vehd
