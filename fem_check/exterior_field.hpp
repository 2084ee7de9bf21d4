#pragma once

#include "fem_check/surface_terms.hpp"

/// Conditions on a sphere for fields that decay outside it, exact for spherical harmonics of low degree: the operators
/// from values there to ∂u/∂r of a potential and to −p n + μ ∂u/∂r of a flow. docs/weak_forms.md, outer sphere
namespace vehd::fem_check {

/// (l + 1) − robin for every harmonic of degree l, which decays as r^(−l−1); a matrix on coefficients of harmonics up
/// to this degree. Lengths in units of R.
Eigen::MatrixXd exterior_potential(int degree, double robin);

/// The condition of a flow over μ, a matrix on coefficients of the three components up to one degree more. Velocities
/// on the sphere are sums of ∇(r^l Y), r̂ × ∇Y and ∇(r^(−l−1) Y) at r = 1, l ≥ 1; outside these decay as r^(−l) with a
/// pressure, r^(−l−1) and r^(−l−2), for which −p n + μ ∂u/∂r is −3l²/(l + 1), −(l + 1) and −(l + 2) times μ u. l = 1
/// has the Stokeslet and the rotlet, l = 2 the stresslet.
Eigen::MatrixXd exterior_flow(int degree, double robin);

/// Beside a wall outside of which a field goes on as its mirror image, exactly: one of these matrices for the half
/// sphere on which the field is known.
/// @param mirror  [components x components], the values at the image of a point over those at the point: 1 at an
///                insulating wall, −1 at an electrode, I − 2 n nᵀ for the flow along a stress-free wall
/// @param normal  n, of the wall
Eigen::MatrixXd continued(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& mirror, const Vector3& normal);

/// As exterior_flow, for flows that vanish on a wall through the centre of the sphere: sums of those of its fields that
/// decay with one power of r, −1 to −degree, and vanish there. On the half sphere these are not orthogonal. For a
/// velocity that is a sum U c of them the condition −p n + μ ∂u/∂r = −μ T c is exact; of any other one, c is such that
/// the rest is orthogonal to T, and has −robin μ times itself.
Eigen::MatrixXd exterior_flow_at_rest_on_wall(int degree, double robin, const Vector3& normal);

/// A symmetric matrix on the coefficients of the low harmonics of fields on the outer sphere, as an operator on its
/// nodes: to += B S Bᵀ from, B the integrals of harmonics times nodal functions.
class HarmonicTerms {
 public:
  /// @param matrix  S, [components x harmonics] squared, the harmonics of a component in a row
  HarmonicTerms(const Space& space, const dealii::DoFHandler<3>& handler, const Constraints& constraints,
                const OuterSphere& sphere, unsigned n_components, Eigen::MatrixXd matrix);

  /// One vector per component. Fixed nodes take no part.
  void add(const std::vector<Distributed*>& to, const std::vector<const Distributed*>& from) const;

 private:
  MPI_Comm communicator_;
  std::vector<DofIndex> dofs_;  // free nodes of this rank
  Eigen::MatrixXd moments_;     // B, [nodes of this rank x harmonics]
  Eigen::MatrixXd matrix_;
};

}  // namespace vehd::fem_check
