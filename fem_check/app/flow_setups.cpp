#include "fem_check/app/flow_setups.hpp"

#include "fem_check/app/vesicle_fields.hpp"

namespace vehd::fem_check {

FlowSetups::FlowSetups(const std::vector<CheckInput>& inputs)
    : viscosity_in_(number_of(inputs, &Physics::viscosity_in)), viscosity_out_(inputs.front().physics.viscosity_out) {
  if (inputs.front().wall) wall_ = inputs.front().wall->flow;
}

const FlowOperators& FlowSetups::at(const Discretisation& space) {
  const auto found = operators_.find(space.degree());
  if (found != operators_.end()) return found->second;
  return operators_.emplace(space.degree(), FlowOperators(space, viscosity_in_, viscosity_out_, wall_)).first->second;
}

FlowProblem FlowSetups::problem() const {
  FlowProblem problem;
  problem.viscosity_in = viscosity_in_;
  problem.viscosity_out = viscosity_out_;
  problem.wall = wall_;
  return problem;
}

}  // namespace vehd::fem_check
