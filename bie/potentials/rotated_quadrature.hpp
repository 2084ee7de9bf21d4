#pragma once

#include <vector>

#include "bie/sphere/grid.hpp"
#include "bie/sphere/rotation.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Nodes of the singular quadrature in a frame whose pole is the target: Gauss-Legendre in θ itself on (0, π),
/// equispaced in φ with half a step of offset. In ∫ K J f dω the factor sin θ of dω cancels the 1/|r| of the kernel,
/// so that the integrand is smooth, Eq. (23). Tables depend only on the order and the node counts.
struct RotatedQuadrature {
  int order = 0;
  int n_theta = 0;
  int n_phi = 0;                     ///< a multiple of four
  Vector weight;                     ///< [n_theta], Gauss weight sin θ 2π/n_phi
  std::vector<RowMatrix> synthesis;  ///< per m tables of T, dT/dθ, mT/sin θ stacked [3 n_theta x (order + 1 − m)]
  /// Fourier sums on one quarter of the circle, [n_phi/4 x modes]; parity gives the other three.
  RowMatrix cosine_even, cosine_odd, sine_even, sine_odd;
  std::vector<RotationY> rotations;     ///< one per target latitude of the order-p grid
  std::vector<Matrix> target_analysis;  ///< per m Gauss weight times T at the targets, [n_theta x (order + 1 − m)]

  [[nodiscard]] Index n_nodes() const { return Index{n_theta} * n_phi; }
};

/// @param oversampling  nodes in θ per degree: n_theta = ceil(oversampling * order) + a constant for low orders
/// @param targets       the grid whose nodes are the targets; its order is that of the densities
/// Accuracy: spectral in the oversampling; results on shape (33) at p = 16 with the default 1.15 are within 1e-5 of
/// those with 4.0 (tests/potentials/quadrature_test.cpp)
/// Source: paper Eq. (23) with the pole at the target, but Gauss-Legendre nodes in θ in place of its weights
RotatedQuadrature make_rotated_quadrature(const SphereGrid& targets, double oversampling);

}  // namespace vehd
