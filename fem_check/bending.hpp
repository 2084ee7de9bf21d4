#pragma once

#include <memory>

#include "fem_check/discretisation.hpp"
#include "fem_check/per_vesicle.hpp"
#include "fem_check/surface_elements.hpp"

namespace vehd::fem_check {

/// E_b = κ_B ∫ (H − c)² dA, H = −1 on the unit sphere.
struct BendingEnergy {
  double modulus = 0.0;                ///< κ_B
  double spontaneous_curvature = 0.0;  ///< c, as H; the usual C₀ is −2c
};

/// Bending of a surface of isoparametric elements, computed from the positions of its nodes only. The curvature vector
/// h = 2H n is a nodal field of the same degree,
///
///   ∫ h·w dA = −∫ ∇_γ x:∇_γ w dA for every nodal w,
///
/// and the energy is E_h = κ_B/4 ∫ |h − 2c n|² dA. The force is minus the exact derivative of this discrete energy with
/// respect to the positions: with y = κ_B/2 (h − 2c P n), P the L2 projection onto nodal fields,
///
///   δE_h[w] = ∫ [(κ_B/4 |h − 2cn|² − h·y − ∇_γ·y) ∇_γ·w + κ_B c h·(∇_γ w)ᵀn + tᵇ·∂_a w tᵃ·∂_b y
///                − gᵃᵇ (n·∂_a w)(n·∂_b y)] dA.
///
/// Accuracy: derivative of the energy to rounding; convergence rates and forces on ellipsoids:
/// tests/fem_check/bending_test.cpp
/// Source: Dziuk 2008; Barrett, Garcke and Nürnberg 2008; docs/weak_forms.md
class BendingElements {
 public:
  /// @param degree  of the surface and of h, at least 2: h of degree 1 does not converge
  /// @throws std::invalid_argument for a lower degree or a mesh of tetrahedra
  BendingElements(const meshes::VolumeMesh& mesh, int degree);

  [[nodiscard]] const SurfaceElements& surface() const { return surface_; }
  /// h at the nodes, [3 x nodes].
  [[nodiscard]] Vectors curvature_vector(const Vectors& positions) const;
  [[nodiscard]] double energy(const PerVesicle<BendingEnergy>& energy, const Vectors& positions) const;
  /// −δE_h[w] for the nodal functions w = φ e_d, row d: force times length, [3 x nodes].
  [[nodiscard]] Vectors force_functional(const PerVesicle<BendingEnergy>& energy, const Vectors& positions) const;

 private:
  SurfaceElements surface_;
};

/// Restricts a functional on nodal fields of one degree to those of a lower degree on the same faces, a subspace.
Vectors restricted(const Vectors& functional, const FaceNodes& from, const FaceNodes& to);

/// f_b of the finite elements on the mesh of a discretisation: −δE_b[w], computed once, in several spaces.
/// Accuracy: 1e-3 on a 2:1 prolate (tests/fem_check/bending_test.cpp)
class BendingForce {
 public:
  /// @param degree  of the surface on which the energy is computed
  /// @throws std::invalid_argument for a degree below 2
  BendingForce(const Discretisation& discretisation, const PerVesicle<BendingEnergy>& energy, int degree);

  /// Nodal field of this degree with ∫ f_b·w dA = −δE_b[w] for every nodal w of the degree. Represents a rough force
  /// better than on_trace(), whose degree is that of the flow.
  /// @throws std::invalid_argument for a degree above that of the surface
  [[nodiscard]] VectorOnSurface field(int degree) const;
  /// Function in the trace space of the discretisation with ∫ f_b·w dA = −δE_b[w] for every trace function w; for
  /// FlowProblem::force.
  /// @throws std::invalid_argument if the degree of the discretisation is above that of the surface
  [[nodiscard]] VectorOnSurface on_trace() const;
  /// Unknowns of the surface, three for each node.
  [[nodiscard]] long n_unknowns() const { return functional_.size(); }

 private:
  std::shared_ptr<const Space> space_;
  BendingElements elements_;
  Vectors functional_;
};

/// BendingForce::on_trace() with a surface of this degree.
VectorOnSurface bending_force(const Discretisation& discretisation, const BendingEnergy& energy, int degree);

}  // namespace vehd::fem_check
