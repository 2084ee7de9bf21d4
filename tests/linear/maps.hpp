#pragma once

#include "bie/linear/solve_report.hpp"

namespace vehd::testing {

/// Unsymmetric, non-normal matrix: diagonal from 1 to `largest`, `above` on the first superdiagonal and `below` on the
/// third subdiagonal.
inline Matrix banded_matrix(Index size, double largest, double above, double below) {
  Matrix matrix = Vector::LinSpaced(size, 1.0, largest).asDiagonal();
  matrix.diagonal(1).setConstant(above);
  matrix.diagonal(-3).setConstant(below);
  return matrix;
}

inline LinearMap map_of(const Matrix& matrix) {
  return [&matrix](const Vector& x) -> Vector { return matrix * x; };
}

inline Vector identity(const Vector& x) { return x; }

}  // namespace vehd::testing
