#include "fem_check/slip_wall.hpp"

namespace vehd::fem_check {

SlipWall::SlipWall(const Space& space, const Multigrid& tangential, const Fixed& fixed, const ScalarForm& form)
    : tangential_(tangential), normal_component_(space, fixed, form, Multigrid::Finest::preconditions) {
  const Vector3& normal = space.mesh->wall()->normal;
  frame_ << normal.unitOrthogonal(), normal.cross(normal.unitOrthogonal()), normal;
  Distributed velocity;
  tangential.finest().initialize(velocity);
  for (const DofIndex dof : nodes_on(space.wall, space, tangential.finest().handler())) {
    if (velocity.locally_owned_elements().is_element(dof)) {
      nodes_.push_back(velocity.get_partitioner()->global_to_local(dof));
    }
  }
}

void SlipWall::project(Blocks& velocity) const {
  for (const unsigned node : nodes_) {
    double along = 0.0;
    for (unsigned d = 0; d < 3; ++d) along += frame_(d, 2) * velocity.block(d).local_element(node);
    for (unsigned d = 0; d < 3; ++d) velocity.block(d).local_element(node) -= along * frame_(d, 2);
  }
}

void SlipWall::precondition(Blocks& to, const Blocks& from) const {
  Distributed residual(from.block(0)), component(from.block(0));
  for (unsigned d = 0; d < 3; ++d) to.block(d) = 0.0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    residual = 0.0;
    for (unsigned d = 0; d < 3; ++d) residual.add(frame_(d, axis), from.block(d));
    (axis == 2 ? normal_component_ : tangential_).vmult(component, residual);
    for (unsigned d = 0; d < 3; ++d) to.block(d).add(frame_(d, axis), component);
  }
}

}  // namespace vehd::fem_check
