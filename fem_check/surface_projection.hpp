#pragma once

#include "fem_check/surface_elements.hpp"

namespace vehd::fem_check {

/// Nodal field u with given ∫ u·φ dA = F[φ] for every nodal function φ, on a surface with given positions. Uses
/// matrix-free conjugate gradients: a matrix for degree 15 would need as much memory as all data of the volume, whereas
/// about thirty steps suffice at any degree, since nodal functions of Gauss–Lobatto points are nearly orthogonal.
class SurfaceProjection {
 public:
  /// @param nodes  of the functions, of at most the degree of the surface
  SurfaceProjection(const SurfaceElements& surface, const Vectors& positions, const FaceNodes& nodes);

  /// @param functional  F for φ e_d in row d, [3 x nodes]
  /// @return            u at the nodes, [3 x nodes], to rounding
  /// @throws SolveError if the iteration does not converge
  [[nodiscard]] Vectors solve(const Vectors& functional) const;

 private:
  class Mass;

  const FaceNodes& nodes_;
  Eigen::MatrixXd value_;   // [points of a face x its nodes]
  Eigen::MatrixXd weight_;  // [points of a face x faces]
  Vector diagonal_;         // ∫ φ² dA
};

}  // namespace vehd::fem_check
