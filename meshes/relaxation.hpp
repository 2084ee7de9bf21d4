#pragma once

#include <functional>

#include "meshes/distortion.hpp"

namespace vehd::meshes {

/// Nodes of a lattice, found for given places of those on its boundary.
///
/// The boundary is carried from a valid mesh to where it has to be, a part of the way at a time. At every stop the
/// inner nodes first follow by a linear solution, then the energy of Distortion is lowered (limited-memory BFGS,
/// preconditioned by Distortion::stiffness). A part is halved as long as cells would be squeezed to a fifth, so that no
/// cell is ever inverted.
/// @param start  nodes of a valid mesh, the undistorted one up to a rotation
/// @param boundary_at  places of the nodes on the boundary at a share of the way, 0 at `start`, 1 at the end; the other
///                     columns do not matter
/// @throws MeshError if the parts of the way become too small: the mesh cannot follow
/// Source: Persson and Peraire 2009, with another energy
Eigen::Matrix3Xd relaxed_nodes(const Lattice& lattice, const Distortion& distortion, const Eigen::Matrix3Xd& start,
                               const std::function<Eigen::Matrix3Xd(double share)>& boundary_at);

}  // namespace vehd::meshes
