#pragma once

#include "bie/sphere/transform.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Closed surface x(θ, φ) sampled on one grid, with everything that its first two derivatives determine.
/// Immutable. All arrays have one row per grid point; vectors are [n_points x 3]. Frame index 1 is e_θ, 2 is e_φ of
/// the unit sphere (so no entry is singular at the poles).
struct Surface {
  Matrix position;
  Matrix tangent_1, tangent_2;  ///< covariant basis x_a
  Matrix dual_1, dual_2;        ///< contravariant basis a^a = g^ab x_b; ∇_γ f = f_1 a^1 + f_2 a^2
  Matrix normal;                ///< outward unit normal
  Vector area_element;          ///< J = W/sin θ, Eq. (20): dA = J dω on the unit sphere
  Vector g11, g12, g22;         ///< inverse metric g^ab
  Vector laplace_1, laplace_2;  ///< g^ab C^c_ab, C the surface's connection minus the sphere's
  Vector mean_curvature;        ///< H = −1 on the unit sphere
  Vector gauss_curvature;       ///< K = 1 on the unit sphere
  Vector quadrature;            ///< weight J: ∫ f dA = Σ f quadrature

  [[nodiscard]] Index n_points() const { return position.rows(); }
};

/// Surface from coefficients of x on the transform's grid.
Surface make_surface(const SphereTransform& transform, const Matrix& position_coefficients);

/// ∇_γ f, [n_points x 3], from the derivatives of one scalar field; Eq. (19).
Matrix surface_gradient(const Surface& surface, const SphereDerivatives& scalar);
/// ∇_γ·v for a vector field with all three Cartesian components, tangential or not.
Vector surface_divergence(const Surface& surface, const SphereDerivatives& vector);
/// Δ_γ of every column; needs the Hessian.
Matrix surface_laplacian(const Surface& surface, const SphereDerivatives& fields);

double surface_area(const Surface& surface);
/// ∫f dA / ∫dA of a vector field, [n_points x 3].
Vector3 surface_mean(const Surface& surface, const Matrix& values);
/// ∫x dA / ∫dA.
Vector3 centroid(const Surface& surface);
/// ∫ x·n dA / 3.
double enclosed_volume(const Surface& surface);

}  // namespace vehd
