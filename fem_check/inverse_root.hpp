#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <vector>

#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// (M⁻¹K)^(−1/2) M⁻¹ for symmetric positive definite sparse K and M, by the trapezoidal rule in t of
///
///   z^(−1/2) = (1/π) ∫ e^(t/2) / (z + eᵗ) dt:
///
/// a sum of solutions with K + eᵗ M. For preconditioners: accurate to a few per cent, symmetric positive definite.
/// Source: Bonito and Pasciak 2015
class InverseRoot {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// Number of a rank and number of ranks, among which the solutions are divided.
  struct Share {
    int number = 0, of = 1;
  };

  /// @param stiffness, mass    K and M, [nodes x nodes]
  /// @param smallest, largest  bounds of the eigenvalues of M⁻¹K
  InverseRoot(const Matrix& stiffness, const Matrix& mass, double smallest, double largest, Share share);

  /// Sum of this rank's solutions for x, both [nodes]; the sum over all ranks is the result.
  [[nodiscard]] Vector apply(const Vector& x) const;

 private:
  std::vector<double> weight_;
  std::vector<std::unique_ptr<Eigen::SimplicialLLT<Matrix>>> shifted_;
};

}  // namespace vehd::fem_check
