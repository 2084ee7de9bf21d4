#pragma once

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/flow_setups.hpp"
#include "fem_check/app/level.hpp"
#include "fem_check/app/level_loop.hpp"
#include "fem_check/app/potential_levels.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

/// Flow determined by shape, V_m and material parameters on one discretisation, see solve_shape_levels().
/// @param electric  f_E; empty: none
/// @throws SolveError
Solved solve_shape_flow(const CheckInput& input, const Discretisation& space, const Refinement& refinement,
                        const VectorOnSurface& electric);

/// Flow determined by the shape, at rising degree: f_b from the bending energy of the elements, f_E from their
/// potential, weight, and the tension that keeps every area element. Surface fields: velocity; bending, f_b without
/// spontaneous curvature, if there is a bending modulus; spontaneous_curvature, its contribution to f_b, if there is
/// one; tension if the membrane is inextensible, without its mean if a uniform one has no effect. With several vesicles
/// the elements provide no tension, hence no flow: only both parts of f_b, and no levels if there are none.
/// @param potential  null without a field; f_E is that of its finest level. The effect of the error of f_E is added to
///                   the last level but one, so that it counts as an error of the last
/// @throws SolveError
LevelSequence solve_shape_levels(const std::vector<CheckInput>& inputs, Meshes& meshes, FlowSetups& setups,
                                 const Refinement& refinement, const PotentialLevels* potential, const Report& report);

}  // namespace vehd::fem_check
