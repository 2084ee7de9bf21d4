#pragma once

#include <vector>

#include "fem_check/space.hpp"

/// Rigid motions of the inside of a vesicle, extended to the outside.
namespace vehd::fem_check {

/// Dimensionless positions of all nodes of this rank's cells; zero for other nodes.
std::vector<Vector3> node_places(const Space& space);

/// Fraction of the rigid motion of one inside at each node.
struct RigidPart {
  std::vector<double> share;
  Vector3 centre = Vector3::Zero();  ///< dimensionless
};

/// Fraction 1 within the sphere around the membrane, then the decay of a rotlet; for a single vesicle.
RigidPart rigid_in_a_sphere(const Space& space, const std::vector<Vector3>& places);

/// Fraction 1 inside, decreasing to 0 over the first layer of cells outside; beside another vesicle or a wall.
RigidPart rigid_in_cells(const Space& space, int vesicle);

}  // namespace vehd::fem_check
