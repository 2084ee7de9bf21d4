#pragma once

#include <Eigen/LU>

#include "bie/physics/membrane_flow.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// Harmonics of one degree at the nodes of the coarsest grid that carries them, common to the matrices of all membranes
/// of that degree.
struct TensionGrid {
  SphereTransform transform;
  SphereDerivatives harmonics;  ///< [n_points x n_coefficients]

  explicit TensionGrid(int order);
};

/// Approximate inverse of λ ↦ J ∇_γ·u of one membrane, u the velocity due to λ: from its matrix −Fᵀ U F with F from λ
/// to J f_λ and U from J f to u, since ∫λ ∇_γ·u dA = −∫f_λ·u dA. Products are formed on the grid of degree p, where
/// they alias; that suffices for a preconditioner. Close to a sphere, where the response to a uniform tension nearly
/// vanishes, a larger one is assumed.
///
/// Accuracy: a coupled solve of fifty prolates takes half as many iterations as with the inverse of a sphere
/// (tests/stepping/solve/tension_solve_test.cpp)
///
/// Source: paper Eqs. (2), (27b)
class TensionInverse {
 public:
  /// @param one            not a sphere
  /// @param entries        coefficients that λ can have, ascending from the mean
  /// @param mean_response  the response to a uniform tension is taken as at least a tenth of this
  TensionInverse(const FlowMembrane& one, const TensionGrid& grid, std::vector<Index> entries, double mean_response);

  /// Entries of λ, [entries], from those of J ∇_γ·u, [entries].
  [[nodiscard]] Vector apply(const Vector& divergence) const;

 private:
  Eigen::PartialPivLU<Matrix> beyond_mean_;  ///< LU of the matrix without the first entry, the mean
  Eigen::RowVectorXd to_mean_;
  Vector of_mean_;  ///< other entries with the response of a unit mean
  double mean_ = 1.0;
};

}  // namespace vehd
