#pragma once

#include <vector>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/level.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

/// Of the bending elements above that of the velocity: four derivatives of x would make f_b the largest error by far.
constexpr int bending_degrees = 6;
/// Of f_b as a field above that of the velocity: it is rougher than all that follows from it.
constexpr int bending_field_degrees = 3;

/// f_b of all vesicles from the bending energy of their surfaces, at the degrees of the flow from the shape. Surface
/// field: bending; no levels where no membrane resists bending.
LevelSequence solve_bending_levels(const std::vector<CheckInput>& inputs, Meshes& meshes, const Refinement& refinement,
                                   const Report& report);

}  // namespace vehd::fem_check
