#pragma once

#include <vector>

#include "fem_check/space.hpp"

/// Motions of a vesicle that is rigid inside, continued to the outside.
namespace vehd::fem_check {

/// Places of all nodes of this rank's cells, without unit; zero for others.
std::vector<Vector3> node_places(const Space& space);

/// How much of the motion of one rigid inside each node takes part in.
struct RigidPart {
  std::vector<double> share;
  Vector3 centre = Vector3::Zero();  ///< without unit
};

/// All of it up to the sphere around the membrane, then with the decay of a rotlet: of a single vesicle.
RigidPart rigid_in_a_sphere(const Space& space, const std::vector<Vector3>& places);

/// All of it inside, falling to nothing over the first layer of cells outside: where other membranes are near.
RigidPart rigid_in_cells(const Space& space, int vesicle);

}  // namespace vehd::fem_check
