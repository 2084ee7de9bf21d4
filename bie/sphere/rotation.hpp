#pragma once

#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// Rotation about the y axis in harmonic space: coefficients of f(R_y(β) s) from those of f(s), where R_y(β) takes
/// the north pole to colatitude β, longitude 0. Cosine and sine harmonics do not mix.
struct RotationY {
  /// Per degree n: [n+1 x n+1] for m = 0..n, row: m after, column: m before.
  std::vector<Matrix> cosine;
  /// Per degree n: [n x n] for m = 1..n.
  std::vector<Matrix> sine;
};

/// Real Wigner blocks for all degrees ≤ order by the three-term recurrence in n at fixed (m, m'), stable upwards.
/// @param beta  in (0, π), radians
/// Accuracy: rounding; rotated fields to 1e-11, blocks of degree 64 orthogonal to 1e-12
/// (tests/sphere/transform_test.cpp)
/// Source: Gimbutas and Veerapaneni 2013 for its use; recurrence of Wigner's d functions, Varshalovich et al. 1988
RotationY rotation_y(int order, double beta);

/// Coefficients of f(R⁻¹ s): every field, [n_coefficients x n_fields], rotated by R together with its parameter sphere.
/// Components of vectors are not rotated; the caller does that.
/// Accuracy: rounding; a rotation and its inverse to 1e-13 (tests/stepping/state/frame_test.cpp)
Matrix rotated_fields(const Matrix& coefficients, const Matrix3& rotation);

}  // namespace vehd
