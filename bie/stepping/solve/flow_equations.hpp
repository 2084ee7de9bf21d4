#pragma once

#include <optional>
#include <vector>

#include "bie/linear/recycled_subspace.hpp"
#include "bie/physics/membrane_flow.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/solve/tension_inverse.hpp"

namespace vehd {

/// Two scalars on one membrane, coefficients [n_coefficients]; one that does not exist is empty. As unknowns: `shape`
/// is the change h of the mean curvature, Eq. (28), or on a sphere the normal force c that holds it in shape; `tension`
/// is λ. As sides of their equations: h − dt Hop(u) or u·n, and J ∇_γ·u.
struct FlowScalars {
  Vector shape;
  Vector tension;
};

/// Selection of the unknown forces.
struct FlowOptions {
  /// Step size of the implicit bending; 0: only tension is unknown, and bending is a given force.
  double dt = 0.0;
  /// λ_0 on the upsampled grid, [n_points], with which h exerts the force 2 λ_0 h n; empty: zero. The paper's scheme
  /// omits it; deferred corrections converge the better, the more of the true response is implicit.
  Vector held_tension{};
  /// Transform between a degree above p and the upsampled grid; empty: h has degree p. Positions of degree p have
  /// normal parts, and H, of the next degree. Bending does not act there, but λ_0 does, and must be implicit as well:
  /// at large λ_0 dt/(μR) equilibria are unstable otherwise.
  std::optional<SphereTransform> curvature_transform{};
  /// Coefficients of h and, up to degree p, of λ that can differ from zero, ascending; empty: those of the membrane's
  /// symmetry.
  std::vector<Index> entries{};
  bool is_sphere = false;
  bool holds_shape = false;  ///< of a sphere, by the force c n
};

/// Whether a uniform tension moves nothing, as on a sphere: the constraint then does not determine it, and the area
/// cannot change at constant volume. With undulations the area determines it.
/// @param membrane  counts as a sphere up to thresholds::sphere_variation
bool uniform_tension_is_free(const FlowParameters& parameters, const Membrane& membrane);

/// The linear equations for the unknown forces on one frozen membrane, Eqs. (27) and (28): with
///   f = F h + 2 λ_0 h n + T λ  (F of Eq. (28a), T of Eq. (28c)),
/// and u the velocity under f,
///   h − dt Hop(u) = …,   J ∇_γ·u = ….
/// Scalars replace the three components of x^{n+1}, which (27a) needs only through H^{n+1}.
///
/// - With undulations the area is free, J (∇_γ·u − e) = …: the uniform dilation e replaces the first coefficient of λ
///   as unknown, and λ has the mean 0.
/// - A sphere is held in shape by c n minus its mean, c of degrees 2 … p − 1, so that u·n = …. At the highest degree
///   truncation leaves a single velocity, which λ determines. The mean of λ stays zero.
///
/// In vectors of unknowns each scalar is divided by its scale, to be comparable in a norm: one step of size dt bends a
/// membrane of radius R by h R and strains it by λ dt/(μR), or by λ R²/κ_B if bending responds within the step.
/// Source: paper Eqs. (5), (27), (28); preconditioned with the spectrum of the sphere as Veerapaneni et al. 2011
class FlowEquations {
 public:
  /// @param one  its membrane must outlive the equations
  FlowEquations(const FlowMembrane& one, FlowOptions options);
  /// Makes approximate_inverse that of the membrane's own response, if λ is the only unknown.
  void find_inverse(const TensionGrid& grid);

  [[nodiscard]] const Membrane& membrane() const { return one_.membrane; }
  [[nodiscard]] Index size() const { return n_shape() + n_tension(); }
  /// Transform between the degree of h and the upsampled grid; the degree is p without λ_0.
  [[nodiscard]] const SphereTransform& curvature_transform() const {
    return options_.curvature_transform && options_.held_tension.size() > 0 ? *options_.curvature_transform
                                                                            : membrane().fine;
  }

  /// Coefficients of the scalars of a vector of unknowns, [size()].
  [[nodiscard]] FlowScalars unknowns(const Vector& v) const;
  /// The vector of unknowns, [size()], of scalars; the inverse of unknowns().
  [[nodiscard]] Vector over_scales(const FlowScalars& unknowns) const;
  /// Initial guess of λ, with its known mean if there are undulations; c is zero.
  /// @param tension  λ, coefficients [n_coefficients], or empty
  [[nodiscard]] FlowScalars guess(const Vector& tension) const;
  /// A vector of unknowns, [size()], without the uniform part of λ.
  [[nodiscard]] Vector without_mean(Vector unknowns) const;

  /// f on the fluid per area, values on the upsampled grid, [n_points x 3]; empty without unknowns.
  [[nodiscard]] Matrix force(const FlowScalars& unknowns) const;
  /// Left sides of the equations as rows, [size()], without scales.
  /// @param velocity  u under the unknown forces, coefficients [n_coefficients x 3]
  /// @param unknowns  [size()]
  [[nodiscard]] Vector left_side(const Matrix& velocity, const Vector& unknowns) const;
  /// Left sides of a given velocity, [n_coefficients x 3].
  [[nodiscard]] Vector left_side(const Matrix& velocity) const { return left_side(velocity, Vector::Zero(size())); }
  /// Right sides as rows, [size()].
  [[nodiscard]] Vector rows(const FlowScalars& right_side) const;
  /// Unknowns from rows, [size()] both: exact on the sphere of the same area, for the actual κ_B, both viscosities and
  /// dt.
  [[nodiscard]] Vector approximate_inverse(const Vector& rows) const;

  /// Rows, [size()], of an image of this membrane, from those of this membrane.
  [[nodiscard]] Vector image(const ImageOfFields& image, const Vector& rows) const;

  /// Converts (h, λ) ↦ (Hop(u), J ∇_γ·u) of RecycledSubspaces to unknowns ↦ left sides.
  [[nodiscard]] RecycledSubspace in_system(const RecycledSubspace& recycled) const;
  /// The inverse of in_system.
  [[nodiscard]] RecycledSubspace in_scalars(const RecycledSubspace& recycled) const;

 private:
  [[nodiscard]] Index n() const { return std::ssize(options_.entries); }
  [[nodiscard]] bool bends() const { return options_.dt > 0.0 && one_.parameters.bending.has_value(); }
  [[nodiscard]] bool has_shape() const { return bends() || options_.holds_shape; }
  [[nodiscard]] bool has_tension() const { return one_.parameters.inextensible; }
  [[nodiscard]] Index n_shape() const { return has_shape() ? n() : 0; }
  [[nodiscard]] Index n_tension() const { return has_tension() ? n() : 0; }
  [[nodiscard]] bool area_is_free() const { return of_dilation_.size() > 0; }
  [[nodiscard]] bool is_shape(Index entry) const;
  [[nodiscard]] bool is_tension(Index entry) const { return entry < n_coefficients(membrane().fine.order()); }
  [[nodiscard]] Vector spread(const Eigen::Ref<const Vector>& of_entries, Index count) const;
  [[nodiscard]] Eigen::Matrix2d sphere_inverse(int degree) const;
  void with_mean(double mean, Vector& tension) const;
  void find_sphere_inverse();

  FlowMembrane one_;
  FlowOptions options_;
  double shape_scale_ = 1.0;
  double tension_scale_ = 1.0;
  Vector of_dilation_;  ///< −J/(μR), rows of λ, if the area is free; else empty
  Matrix inverse_;      ///< of the sphere: the 2 x 2 block of each entry, by rows, [n x 4]
  std::optional<TensionInverse> of_membrane_;
};

}  // namespace vehd
