#pragma once

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/flow_setups.hpp"
#include "fem_check/app/level.hpp"
#include "fem_check/app/level_loop.hpp"
#include "fem_check/app/potential_levels.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

/// The flow that follows from the shape, V_m and the physics alone, on one discretisation, see solve_shape_levels().
/// @param electric  f_E; empty: none
/// @throws SolveError
Solved solve_shape_flow(const CheckInput& input, const Discretisation& space, const Refinement& refinement,
                        const VectorOnSurface& electric);

/// The flow from the shape at rising degree: f_b from the bending energy of the elements, f_E from their potential,
/// weight, and the tension that keeps every area element. Surface fields: velocity; bending, f_b without spontaneous
/// curvature, where a membrane resists bending; spontaneous_curvature, what that adds to f_b, where there is one;
/// tension where it is inextensible, without its mean where a uniform one does nothing. Of several vesicles the
/// elements have no tensions, hence no flow: both parts of f_b alone, and no levels where there are none.
/// @param potential  null without a field; f_E is that of its finest level. What that leaves out stands between the
///                   last two levels, as an error of the last
/// @throws SolveError
LevelSequence solve_shape_levels(const std::vector<CheckInput>& inputs, Meshes& meshes, FlowSetups& setups,
                                 const Refinement& refinement, const PotentialLevels* potential, const Report& report);

}  // namespace vehd::fem_check
