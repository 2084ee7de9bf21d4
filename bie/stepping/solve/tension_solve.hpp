#pragma once

#include <vector>

#include "bie/linear/recycled_subspace.hpp"
#include "bie/linear/solve_report.hpp"
#include "bie/physics/membrane_flow.hpp"

namespace vehd {

/// Tensions that keep all membranes inextensible, with their forces and velocities.
struct SolvedTensions {
  std::vector<Vector> tension;     ///< λ of each, [n_coefficients]; empty where the membrane may extend
  std::vector<Matrix> force;       ///< f_λ on the fluid, upsampled grid, [n_points x 3]; empty likewise
  std::vector<Matrix> velocities;  ///< u + w of the membranes, [n_coefficients x 3]
  /// Recycled by the next solve: of each membrane its rows of the map of all, λ ↦ J ∇_γ·u; the columns are in common.
  /// Empty of many membranes, and where one is a sphere.
  std::vector<RecycledSubspace> recycled;
  SolveReport report;
};

/// Solves ∇_γ·(u + w) = 0 on every inextensible membrane, Eq. (27b), u the velocity under the tensions of all and w
/// that under the other forces. The unknowns are λ/R, preconditioned with the sphere's inverse on each membrane, or
/// with that of each membrane's own response (TensionInverse) where there are many.
///
/// The mean of λ stays zero on a sphere. An inextensible sphere is rigid but for flow within it (rigid_sphere.hpp):
/// where it acts on others or has an image in a wall a force c n, c of degrees 2 … p − 1, less its mean holds it in
/// shape, the limit of a large uniform tension on a shape that hardly differs from a sphere; it is an unknown beside λ,
/// and counts as force of the tension. Alone it has the velocity of Eq. (27b).
///
/// Of several ranks, see Interaction, each needs the forces on its own membranes. It gets forces and velocities of
/// these, and the tensions and recycled directions of all.
/// @param is_sphere   of each membrane, see uniform_tension_is_free
/// @param weighted    of J f, f the other forces, [n_coefficients x 3], see MembraneFlow::velocities; likewise the
///                    background
/// @param start       λ of each to start from, [n_coefficients]; empty ones are zero. Their flow is found with w.
/// @param recycled    SolvedTensions::recycled on membranes that were nearly the same; counts if all of them have it
/// @param tolerance   of the preconditioned residual, over the preconditioned ∇_γ·w or, from a start, over the tensions
///                    without their means, of which it is the error
/// Accuracy: two spheres along their line of centres as Stimson and Jeffery say to 1e-8 down to gaps of half a radius
/// (tests/stepping/solve/tension_solve_test.cpp)
/// Source: paper Eq. (27b), the layers being those of all membranes
SolvedTensions solve_tensions(const std::vector<FlowMembrane>& membranes, const std::vector<bool>& is_sphere,
                              MembraneFlow& flow, std::vector<Matrix> weighted, const std::vector<Matrix>& background,
                              const std::vector<Vector>& start, const std::vector<RecycledSubspace>& recycled,
                              double tolerance);

}  // namespace vehd
