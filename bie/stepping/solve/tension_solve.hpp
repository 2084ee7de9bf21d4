#pragma once

#include <vector>

#include "bie/linear/recycled_subspace.hpp"
#include "bie/linear/solve_report.hpp"
#include "bie/physics/membrane_flow.hpp"

namespace vehd {

/// Tensions that keep all membranes inextensible, with their forces and velocities.
struct SolvedTensions {
  std::vector<Vector> tension;     ///< λ of each, [n_coefficients]; empty if the membrane can extend
  std::vector<Matrix> force;       ///< f_λ on the fluid, upsampled grid, [n_points x 3]; empty if λ is
  std::vector<Matrix> velocities;  ///< u + w of the membranes, [n_coefficients x 3]
  /// For the next solve: the rows of each membrane in the joint map λ ↦ J ∇_γ·u, with common columns. Empty for many
  /// membranes, and if one is a sphere.
  std::vector<RecycledSubspace> recycled;
  SolveReport report;
};

/// Solves ∇_γ·(u + w) = 0 on every inextensible membrane, Eq. (27b), u the velocity under the tensions of all and w
/// that under the other forces. The unknowns are λ/R, preconditioned with the sphere's inverse on each membrane, or
/// with that of each membrane's own response (TensionInverse) if there are many.
///
/// The mean of λ stays zero on a sphere. An inextensible sphere is rigid except for flow within it (rigid_sphere.hpp).
/// If it acts on others or has an image in a wall, a force c n minus its mean, c of degrees 2 … p − 1, holds it in
/// shape: the limit of a large uniform tension on a shape that hardly differs from a sphere. c is unknown beside λ, and
/// its force is added to that of the tension. Otherwise a sphere has the velocity of Eq. (27b).
///
/// With several ranks, see Interaction, each needs the forces on its own membranes. It gets forces and velocities of
/// these, and the tensions and recycled directions of all.
/// @param is_sphere   of each membrane, see uniform_tension_is_free
/// @param weighted    of J f, f the other forces, [n_coefficients x 3], see MembraneFlow::velocities, also for
///                    background
/// @param start       initial λ of each, [n_coefficients]; empty ones are zero. Its flow is found together with w
/// @param recycled    SolvedTensions::recycled on membranes that were nearly the same; used if all of them have it
/// @param tolerance   of the preconditioned residual, over the preconditioned ∇_γ·w or, from a start, over the tensions
///                    without their means, of which it is the error
/// Accuracy: two spheres along their line of centres as in Stimson and Jeffery to 1e-8 down to gaps of half a radius
/// (tests/stepping/solve/tension_solve_test.cpp)
/// Source: paper Eq. (27b), the layers being those of all membranes
SolvedTensions solve_tensions(const std::vector<FlowMembrane>& membranes, const std::vector<bool>& is_sphere,
                              MembraneFlow& flow, std::vector<Matrix> weighted, const std::vector<Matrix>& background,
                              const std::vector<Vector>& start, const std::vector<RecycledSubspace>& recycled,
                              double tolerance);

}  // namespace vehd
