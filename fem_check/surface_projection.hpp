#pragma once

#include "fem_check/surface_elements.hpp"

namespace vehd::fem_check {

/// The nodal field u with given products with the nodal functions, ∫ u·φ dA = F[φ], on a surface with given positions.
/// By conjugate gradients without a matrix: of functions of degree 15 it would take as much memory as everything in the
/// volume, while some thirty steps suffice whatever the degree, as functions on Gauss–Lobatto points are nearly
/// orthogonal.
class SurfaceProjection {
 public:
  /// @param nodes  of the functions, of a degree up to that of the surface
  SurfaceProjection(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes);

  /// @param functional  F for φ e_d in row d, [3 x nodes]
  /// @return            u at the nodes, [3 x nodes], to rounding
  /// @throws SolveError if that is not reached
  [[nodiscard]] Vectors solve(const Vectors& functional) const;

 private:
  class Mass;

  const FaceNodes& nodes_;
  Eigen::MatrixXd value_;   // [points of a face x its nodes]
  Eigen::MatrixXd weight_;  // [points of a face x faces]
  Vector diagonal_;         // ∫ φ² dA
};

}  // namespace vehd::fem_check
