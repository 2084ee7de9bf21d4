#pragma once

#include <Eigen/SparseCore>

#include "bie/support/types.hpp"

/// Solid harmonics R_lm = r^l P_l^m(cos θ) e^{imφ}/(l + m)! and I_lm = (l − m)! P_l^m(cos θ) e^{imφ}/r^{l+1} with the
/// sign (−1)^m in P_l^m, for which 1/|x − y| = Σ conj(R_lm(y)) I_lm(x). Those of m ≥ 0 say all: l² is the index of the
/// real part of order 0, l² + 2m − 1 that of order m, l² + 2m that of its imaginary part.
namespace vehd {

/// Entries of all degrees up to the given one.
constexpr Index n_solid(int degree) { return Index{degree + 1} * (degree + 1); }

/// R at points, [n_points x n_solid].
Matrix regular_harmonics(const Matrix& points, int degree);

/// Δ with ∂R/∂x_axis = R Δ, R one row of regular harmonics.
Eigen::SparseMatrix<double> regular_derivative(int axis, int degree);

/// Moments of unit sources: Σ conj(R), from one row or from a sum of rows of regular harmonics.
Matrix moments(const Matrix& regular_sums);

}  // namespace vehd
