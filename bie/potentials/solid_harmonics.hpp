#pragma once

#include <Eigen/SparseCore>

#include "bie/support/types.hpp"

/// Solid harmonics R_lm = r^l P_l^m(cos θ) e^{imφ}/(l + m)! and I_lm = (l − m)! P_l^m(cos θ) e^{imφ}/r^{l+1} with the
/// sign (−1)^m in P_l^m, for which 1/|x − y| = Σ conj(R_lm(y)) I_lm(x). Orders m ≥ 0 suffice: l² is the index of the
/// real part of order 0, l² + 2m − 1 that of order m, l² + 2m that of its imaginary part.
namespace vehd {

/// (degree + 1)², the number of solid harmonics of degree up to the given one.
constexpr Index n_solid(int degree) { return Index{degree + 1} * (degree + 1); }

/// R at points.
/// @param points  [n_points x 3]
/// @return        [n_points x n_solid]
/// Source: Epton and Dembart 1995
Matrix regular_harmonics(const Matrix& points, int degree);

/// Δ, [n_solid x n_solid], with ∂R/∂x_axis = R Δ, R one row of regular harmonics.
Eigen::SparseMatrix<double> regular_derivative(int axis, int degree);

/// Moments of unit sources, Σ conj(R).
/// @param regular_sums  Σ R over the sources of each column, [n_solid x columns]
/// @return              [n_solid x columns]
Matrix moments(const Matrix& regular_sums);

/// Σ_i R_lm(y_i) q_i over the nodes y_i of a membrane, for several q at a time. A sum reads every entry of R once and
/// its time is that of reading, so entries from degree 10 on have single precision. In an expansion to degree L whose
/// last term has the size of a tolerance τ, the tenth has the size τ^{10/L}; at L = 22 its rounding error 6e-8
/// τ^{10/22} is below any τ above 1e-13.
///
/// Accuracy: rounding up to degree 9, 6e-8 of the largest product beyond (tests/potentials/far_expansions_test.cpp)
class MomentSums {
 public:
  /// @param regular  R at the nodes, [n_nodes x n_solid]
  explicit MomentSums(const Matrix& regular);

  /// @param densities  q, [n_nodes x columns]
  /// @return [n_solid x columns]
  [[nodiscard]] Matrix of(const Matrix& densities) const;

 private:
  Index n_nodes_;
  // Padded with zeros to whole registers.
  Matrix low_;
  Eigen::MatrixXf high_;
  Vector scale_;  ///< of the columns of high_, whose entries are at most 1
};

}  // namespace vehd
