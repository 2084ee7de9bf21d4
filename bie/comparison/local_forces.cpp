#include "bie/comparison/local_forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bie/physics/effects/bending.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

LocalForces local_forces(const FrozenState& frozen, const Membrane& membrane, const Matrix& position,
                         std::size_t vesicle) {
  const VesicleModel& model = frozen.model.vesicles[vesicle];
  LocalForces forces;
  forces.order = membrane.fine.order();
  if (model.bending) forces.bending = membrane.fine.analyze(bending_force(*model.bending, membrane));
  for (const auto& effect : model.effects) {
    if (effect->spontaneous_curvature() == 0.0) continue;
    Forcing forcing{Matrix::Zero(membrane.surface.n_points(), 3), {}};
    effect->add({membrane, position, frozen.state.time}, forcing);
    forces.curvature = membrane.fine.analyze(forcing.force);
  }
  return forces;
}

LocalForces local_forces(const FrozenState& frozen, int order, std::size_t vesicle) {
  const Matrix position = resize_order(frozen.state.vesicles[vesicle].position, order);
  const SphereTransform fine(order, make_grid(frozen.settings.upsampling * order));
  Surface surface = make_surface(fine, position);
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  const Membrane membrane{fine, std::move(surface), {}, radius, SymmetrySubspace({}, order)};
  return local_forces(frozen, membrane, position, vesicle);
}

int local_force_order(int order, int solved) { return solved == order ? order : std::max(2 * order, solved); }

LocalForces local_forces_beside(const FrozenState& frozen, const Membrane& membrane, const Matrix& position,
                                std::size_t vesicle) {
  const int solved = order_of(position.rows());
  const int order = local_force_order(order_of(frozen.state.vesicles[vesicle].position.rows()), solved);
  return order == solved ? local_forces(frozen, membrane, position, vesicle) : local_forces(frozen, order, vesicle);
}

}  // namespace vehd
