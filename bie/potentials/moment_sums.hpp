#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Σ_i R_lm(y_i) q_i over the nodes y_i of a membrane, for several q at a time. Every entry of R is read once a sum,
/// and reading them is all that a sum takes; so from degree 10 on they have single precision. In an expansion to degree
/// L whose last term is of the size of a tolerance τ the tenth is of the size τ^{10/L}, and at L = 22 rounding of 6e-8
/// τ^{10/22} is below any τ above 1e-13.
///
/// Accuracy: rounding up to degree 9, 6e-8 of the largest product beyond (tests/potentials/far_expansions_test.cpp)
class MomentSums {
 public:
  /// @param regular  R at the nodes, [n_nodes x n_solid]
  explicit MomentSums(const Matrix& regular);

  /// @param densities  q, [n_nodes x columns] @return [n_solid x columns]
  [[nodiscard]] Matrix of(const Matrix& densities) const;

 private:
  Index n_nodes_;
  // Filled up with zeros to whole instructions.
  Matrix low_;
  Eigen::MatrixXf high_;
  Vector scale_;  ///< of the columns of high_, which have entries up to 1
};

}  // namespace vehd
