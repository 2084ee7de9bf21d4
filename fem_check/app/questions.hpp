#pragma once

#include <vector>

#include "fem_check/app/comparison.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

/// The fields of the electric problem: q, Vm, force, q_steady and φ at the sample points.
/// @param points  of the comparison on γ
std::vector<FieldQuestion> electric_questions(const CheckInput& input, const SurfacePoints& points, double radius,
                                              const Refinement& refinement);

/// The fields of the flow: velocity, velocity_own_force and v at the sample points.
std::vector<FieldQuestion> flow_questions(const CheckInput& input, const SurfacePoints& points, double radius,
                                          const Refinement& refinement);

}  // namespace vehd::fem_check
