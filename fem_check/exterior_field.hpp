#pragma once

#include "fem_check/surface_terms.hpp"

/// Conditions on a sphere for fields that decay outside it, exact for spherical harmonics of low degree: operators that
/// map values on the sphere to ∂u/∂r of a potential or to −p n + μ ∂u/∂r of a flow. docs/weak_forms.md, outer sphere
namespace vehd::fem_check {

/// (l + 1) − robin for every harmonic of degree l, which decays as r^(−l−1), as a matrix on the coefficients of
/// harmonics up to this degree, [n_harmonics x n_harmonics]. Lengths in units of R.
Eigen::MatrixXd exterior_potential(int degree, double robin);

/// Condition of a flow over μ, as a matrix on the coefficients of the three components up to degree + 1. Velocities on
/// the sphere are sums of ∇(r^l Y), r̂ × ∇Y and ∇(r^(−l−1) Y) at r = 1, l ≥ 1. Outside they decay as r^(−l), with a
/// pressure, r^(−l−1) and r^(−l−2), and −p n + μ ∂u/∂r is −3l²/(l + 1), −(l + 1) and −(l + 2) times μ u. The Stokeslet
/// and the rotlet have l = 1, the stresslet l = 2.
/// @return [3 n_harmonics x 3 n_harmonics]
Eigen::MatrixXd exterior_flow(int degree, double robin);

/// One of these matrices for the half sphere beside a wall, if the field beyond the wall is the mirror image of the
/// field before it.
/// @param matrix  [n x n], and so the result
/// @param mirror  [components x components], maps the values at a point to those at its image: 1 for an insulating
///                wall, −1 for an electrode, I − 2 n nᵀ for flow along a stress-free wall
/// @param normal  normal n of the wall
Eigen::MatrixXd continued(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& mirror, const Vector3& normal);

/// As exterior_flow, for flows that vanish on a wall through the centre of the sphere. The basis consists of sums of
/// its fields with one power of r, −1 to −degree, that vanish there; they are not orthogonal on the half sphere. For a
/// velocity U c in their span the condition −p n + μ ∂u/∂r = −μ T c is exact; for any other velocity, c makes the
/// remainder orthogonal to T, and the remainder is multiplied by −robin μ.
/// @return [3 n_harmonics x 3 n_harmonics]
Eigen::MatrixXd exterior_flow_at_rest_on_wall(int degree, double robin, const Vector3& normal);

/// A symmetric matrix on the coefficients of the low harmonics of fields on the outer sphere, applied to nodal values:
/// to += B S Bᵀ from, B the integrals of harmonics times nodal functions.
class HarmonicTerms {
 public:
  /// @param matrix  S, [components x harmonics] squared; the harmonics of a component are contiguous
  HarmonicTerms(const Space& space, const dealii::DoFHandler<3>& handler, const Constraints& constraints,
                const OuterSphere& sphere, unsigned n_components, Eigen::MatrixXd matrix);

  /// Adds the product, one vector per component. Fixed nodes are left out.
  void add(const std::vector<Distributed*>& to, const std::vector<const Distributed*>& from) const;

 private:
  MPI_Comm communicator_;
  std::vector<DofIndex> dofs_;  // free nodes of this rank
  Eigen::MatrixXd moments_;     // B, [nodes of this rank x harmonics]
  Eigen::MatrixXd matrix_;
};

}  // namespace vehd::fem_check
