#pragma once

#include <vector>

#include "bie/physics/interaction.hpp"
#include "bie/stepping/evaluation/vesicle_task.hpp"

namespace vehd {

/// How exact the layers between membranes are next to those of each.
PairSettings pair_settings(const NumericalSettings& settings);

/// The layers between the membranes that the effects of a model need; those of the electric problem only while it is
/// active.
/// @throws ConvergenceError if two membranes intersect or are too near for any rule
std::shared_ptr<const Interaction> interaction_of(const std::vector<VesicleTask>& tasks, bool electric_active,
                                                  const Discretisation& discretisation, Instruments& instruments);

/// solve_fields for several vesicles, coupled through the field and the fluid around them: charge densities, Eq. (12),
/// forces, velocities and tensions, Eq. (27b), of all at once.
/// @param solved  with operators and interaction; the rest is found here, for the vesicles of this rank
/// @throws ConvergenceError naming the solve that failed
/// Accuracy: spectral; two spheres approach each other in a field with the exact speed to 1e-8
/// (tests/stepping/evaluation/interacting_fields_test.cpp)
void solve_interacting(const std::vector<VesicleTask>& tasks, double time, Limit limit, Instruments& instruments,
                       SolvedFields& solved);

}  // namespace vehd
