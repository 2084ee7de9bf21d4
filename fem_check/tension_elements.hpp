#pragma once

#include <array>

#include "fem_check/inverse_root.hpp"
#include "fem_check/surface_matrices.hpp"

namespace vehd::fem_check {

/// Tension λ on γ, continuous and of degree k − 1 for a velocity of degree k: Taylor–Hood elements of the surface. One
/// matrix gives both the force of λ and the condition that γ keeps its area elements,
///
///   C_d[χ, φ] = ∫ χ (∇_γ φ)_d dA:  f_λ[w] = −∫ λ ∇_γ·w dA = −Σ_d λᵀ C_d w_d,  ∫ χ ∇_γ·v dA = Σ_d χᵀ C_d v_d.
///
/// Stable: tests/fem_check/tension_elements_test.cpp has inf-sup constants of this pair and of an unstable one.
/// Source: paper Eqs. (1e), (2); docs/weak_forms.md
class TensionElements {
 public:
  /// @param tension_degree  k − 1 in the stable pair
  TensionElements(const meshes::VolumeMesh& mesh, int velocity_degree, int tension_degree);

  [[nodiscard]] const FaceNodes& velocity_nodes() const { return velocity_nodes_; }
  [[nodiscard]] const FaceNodes& tension_nodes() const { return tension_nodes_; }
  /// C_d, [tension nodes x velocity nodes].
  [[nodiscard]] const std::array<SurfaceMatrix, 3>& divergence() const { return divergence_; }
  /// ∫ χ χ' dA and ∫ ∇_γχ·∇_γχ' dA.
  [[nodiscard]] const SurfaceMatrix& mass() const { return mass_; }
  [[nodiscard]] const SurfaceMatrix& stiffness() const { return stiffness_; }
  /// ∫ χ ∇_γ·(A x) dA, [tension nodes].
  [[nodiscard]] Vector divergence_of_linear_flow(const Matrix3& gradient) const;
  /// λ minus its mean over γ, nodal values [tension nodes].
  [[nodiscard]] Vector without_mean(const Vector& tension) const;
  /// λ at points of γ, [points.size()].
  /// @param tension  nodal values, [tension nodes]
  [[nodiscard]] Vector evaluate(const Vector& tension, const SurfacePoints& points) const;

  /// √(∫(H − H̄)² dA / ∫H² dA) of the mesh, 0 on a sphere: relative part of the force of a constant tension, 2λH n,
  /// that is not a pressure.
  [[nodiscard]] double variation_of_curvature() const { return variation_of_curvature_; }
  /// Radius of the sphere of equal area.
  [[nodiscard]] double radius() const { return radius_; }
  /// Upper bound of the eigenvalues of the surface Laplacian on tensions.
  [[nodiscard]] double largest_eigenvalue() const { return largest_eigenvalue_; }

 private:
  SurfaceElements surface_;
  FaceNodes velocity_nodes_;
  FaceNodes tension_nodes_;
  std::array<SurfaceMatrix, 3> divergence_;
  SurfaceMatrix mass_, stiffness_;
  double radius_ = 0.0;
  double largest_eigenvalue_ = 0.0;
  double variation_of_curvature_ = 0.0;
};

/// Tension that compensates a given rate of expansion of γ, up to a factor near 1:
///
///   2 (μ_i + μ_e) (−Δ_γ + 1/R²)^(−1/2).
///
/// On the unit sphere at equal viscosities a tension Y_n makes the membrane contract at
/// n (n + 1) [(n + 2)²/(2n + 3) + (n − 1)²/(2n − 1)]/(2n + 1)² Y_n/μ, by the eigenvalues of the single layer
/// (docs/conventions.md): √(n (n + 1) + 1)/(4μ) up to a factor between 0.92 and 1.
///
/// If H varies little, the force 2λH n of a constant tension is almost a pressure, and the contraction that it causes
/// is smaller by the square of the variation: the preconditioner multiplies the constant by the inverse of this square.
class TensionPreconditioner {
 public:
  /// @param constant_is_free  keeps the mean of tensions at zero, as a constant tension has no effect
  TensionPreconditioner(const TensionElements& elements, double viscosity_in, double viscosity_out,
                        bool constant_is_free, InverseRoot::Share share);

  /// Contribution of this rank to the result, nodal values, [tension nodes].
  /// @param residual  products with the nodal functions of the tension, [tension nodes]
  [[nodiscard]] Vector apply(const Vector& residual) const;

 private:
  double scale_;
  bool constant_is_free_;
  double of_constant_ = 0.0;  // for a residual of sum 1, in addition to that of the root
  Vector mass_of_one_;
  InverseRoot root_;
};

}  // namespace vehd::fem_check
