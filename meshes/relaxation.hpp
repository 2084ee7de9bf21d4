#pragma once

#include <functional>

#include "meshes/distortion.hpp"

namespace vehd::meshes {

/// Nodes of a lattice for given positions of its boundary nodes.
///
/// The boundary is moved from a valid mesh to its final position in increments. After each one the inner nodes first
/// follow by a linear solve, then Distortion::energy is lowered (L-BFGS, preconditioned by its stiffness). An increment
/// that would reduce the smallest det F below a fifth is halved, so that no cell is inverted.
/// @param start  nodes of a valid mesh, the undistorted one up to a rotation
/// @param boundary_at  positions of the boundary nodes at a fraction of the path, 0 at `start`, 1 at the end; the other
///                     columns are not used
/// @throws MeshError if the increments become too small: the mesh cannot follow the boundary
/// Source: Persson and Peraire 2009, with another energy
Eigen::Matrix3Xd relaxed_nodes(const Lattice& lattice, const Distortion& distortion, const Eigen::Matrix3Xd& start,
                               const std::function<Eigen::Matrix3Xd(double share)>& boundary_at);

}  // namespace vehd::meshes
