#pragma once

#include "bie/geometry/surface.hpp"
#include "bie/stepping/state/fields.hpp"

namespace vehd {

/// Tangent vector at every grid point: contravariant components along the covariant basis x_1, x_2.
struct SphereVectors {
  Vector d1, d2;
};

/// The tangential displacement d with the given J ∇_γ·d: its contravariant components are ∇Ψ/J on the unit sphere, so
/// that J ∇_γ·d = ΔΨ.
/// @param weighted_divergence  J ∇_γ·d, values on the upsampled grid, [n_points]; its mean is ignored
SphereVectors displacement_of_divergence(const SphereTransform& fine, const Surface& surface,
                                         const Vector& weighted_divergence);

/// Divergence-free part of the tangential part of `displacement`: with a its contravariant components, J a = ∇Ψ + r̂×∇X
/// on the unit sphere, and only the first part changes area elements. A uniform translation slides no points, so the
/// mean of the displacement over the surface is subtracted.
/// @param displacement  coefficients, [n_coefficients x 3]
/// Accuracy: spectral; a rotation about the centre of a sphere is undone to second order
/// (tests/stepping/space/remap_test.cpp)
/// Source: Helmholtz decomposition on the unit sphere
SphereVectors sliding_part(const SphereTransform& fine, const Surface& surface, const Matrix& displacement);

/// Moves the grid over a surface without moving the surface: each field at the new node s takes its value at the
/// material point Φ(s), by spectral evaluation. Φ undoes the part of the last displacement that only slides points
/// along the surface (the divergence-free part of the tangential velocity, which in tank-treading shears a grid without
/// limit while area elements stay), and takes one descent step of the energy of the high degrees of x (Veerapaneni et
/// al. 2011). Sliding is kept in degrees whose wavelength is not long against it: undoing it would amplify them.
/// Accuracy: spectral; area to 1e-11, volume to 1e-12, energy to 1e-8 at p = 32, new nodes on the old surface to 1e-7
/// (tests/stepping/space/remap_test.cpp)
/// Source: Veerapaneni et al. 2011 for the descent; undoing the sliding is of this project
class GridMove {
 public:
  /// @param fine          degree p ↔ upsampled grid; must outlive it
  /// @param displacement  dt u, the last move of the material, coefficients [n_coefficients x 3]
  /// @param position      of the material points, [n_coefficients x 3]
  GridMove(const SphereTransform& fine, const Matrix& displacement, const Matrix& position);

  /// Fields at the new nodes, from those at the material points.
  [[nodiscard]] SurfaceFields carried(const SurfaceFields& fields) const;
  /// Other fields at the new nodes, coefficients [n_coefficients x n_fields].
  [[nodiscard]] Matrix carried(const Matrix& columns) const;

 private:
  const SphereTransform& fine_;
  Matrix from_;  // unit vectors: the new nodes on the parameter sphere of the material
};

/// The fields of a surface after the move of its grid.
/// @param displacement  see GridMove, [n_coefficients x 3]
SurfaceFields remap(const SphereTransform& fine, const Matrix& displacement, const SurfaceFields& fields);

}  // namespace vehd
