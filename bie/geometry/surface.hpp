#pragma once

#include "bie/sphere/transform.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Closed surface x(θ, φ) sampled on one grid, with the fields that its first and second derivatives determine.
/// Immutable. All arrays have one row per grid point; vectors are [n_points x 3]. Frame index 1 is e_θ, 2 is e_φ of
/// the unit sphere (so no entry is singular at the poles).
/// The normal points from the interior to the exterior if x(θ, φ) keeps the orientation of the unit sphere.
/// Source: paper Eqs. (19)–(22), in the frame of the unit sphere in place of θ and φ
struct Surface {
  Matrix position;
  Matrix tangent_1, tangent_2;  ///< covariant basis x_a
  Matrix dual_1, dual_2;        ///< contravariant basis a^a = g^ab x_b; ∇_γ f = f_1 a^1 + f_2 a^2
  Matrix normal;                ///< outward unit normal
  Vector area_element;          ///< J = W/sin θ, Eq. (20): dA = J dω on the unit sphere
  Vector g11, g12, g22;         ///< inverse metric g^ab
  Vector b11, b12, b22;         ///< second fundamental form b^ab = g^ac g^bd x_cd·n
  Vector laplace_1, laplace_2;  ///< g^ab C^c_ab, C the surface's connection minus the sphere's
  Vector mean_curvature;        ///< H = −1 on the unit sphere
  Vector gauss_curvature;       ///< K = 1 on the unit sphere
  Vector quadrature;            ///< weight J: ∫ f dA = Σ f quadrature

  [[nodiscard]] Index n_points() const { return position.rows(); }
};

/// Surface from coefficients of x on the transform's grid.
/// @param position_coefficients  [n_coefficients x 3]
/// @throws ShapeError unless there are three columns
/// Accuracy: rounding for an x of degree p; H and K of a 2:1 prolate to 1e-12, J to 1e-13
/// (tests/geometry/curvature_test.cpp)
Surface make_surface(const SphereTransform& transform, const Matrix& position_coefficients);

/// J = W/sin θ only, [n_points], from first derivatives.
/// @param position_coefficients  [n_coefficients x 3]
/// @throws ShapeError unless there are three columns
/// Accuracy: that of make_surface, to rounding (tests/geometry/curvature_test.cpp)
/// Source: paper Eq. (20)
Vector area_element(const SphereTransform& transform, const Matrix& position_coefficients);

/// ∇_γ f, [n_points x 3], from the first derivatives of one scalar field, each [n_points x 1].
/// Accuracy: spectral; gradients of smooth functions to 1e-11 (tests/geometry/surface_calculus_test.cpp)
/// Source: paper Eq. (19)
Matrix surface_gradient(const Surface& surface, const SphereDerivatives& scalar);
/// ∇_γ·v, [n_points], from the first derivatives of the three Cartesian components of v, tangential or not, each
/// [n_points x 3].
/// Accuracy: spectral; to 1e-11, and ∫∇_γ·v dA = −2∫H v·n dA to 1e-12 (tests/geometry/surface_calculus_test.cpp)
/// Source: paper Eq. (19)
Vector surface_divergence(const Surface& surface, const SphereDerivatives& vector);
/// Δ_γ f of every column, [n_points x n_fields], from first and second derivatives on the surface's grid.
/// Accuracy: spectral; Δ_γ x = 2Hn to 1e-11 (tests/geometry/surface_calculus_test.cpp)
/// Source: ∇_γ·∇_γ f by paper Eq. (19)
Matrix surface_laplacian(const Surface& surface, const SphereDerivatives& fields);

/// ∫dA.
/// Accuracy: spectral; of a 2:1 prolate to 1e-12 (tests/geometry/curvature_test.cpp)
/// Source: paper Eq. (22)
double surface_area(const Surface& surface);
/// ∫f dA / ∫dA of a vector field, values [n_points x 3].
Vector3 surface_mean(const Surface& surface, const Matrix& values);
/// Centroid of the surface, ∫x dA / ∫dA.
Vector3 centroid(const Surface& surface);
/// Largest minus smallest distance of the grid points from the centroid: zero to rounding on any grid of a sphere.
double distance_variation(const Surface& surface);
/// ∫ x·n dA / 3.
/// Accuracy: spectral; of a 2:1 prolate to 1e-13 (tests/geometry/curvature_test.cpp)
/// Source: Gauss's theorem
double enclosed_volume(const Surface& surface);

}  // namespace vehd
