#pragma once

#include <vector>

#include "fem_check/app/charging_levels.hpp"
#include "fem_check/app/compared_field.hpp"

/// Fields that a check compares, one for each row of the table.
namespace vehd::fem_check {

/// Fields of the electric problem: q, Vm, q_steady, force and φ at the sample points.
std::vector<ComparedField> electric_fields(const CheckInput& input, const ComparisonPoints& at,
                                           const LevelSequence& sequence);

/// Fields of the flow without the background flow: velocity, velocity_own_force and v at the sample points.
std::vector<ComparedField> flow_fields(const CheckInput& input, const ComparisonPoints& at,
                                       const LevelSequence& sequence);

/// Fields determined by shape, V_m and material parameters: f_b, f_c of a spontaneous curvature, tension, and velocity
/// without the background flow; only those that the elements provide.
/// @param of_shape  a level with these fields
std::vector<ComparedField> fields_of_shape(const CheckInput& input, const ComparisonPoints& at, const Level& of_shape);

/// Currents that charge the membrane for given V_m or charges: C dV_m/dt, or dq_i/dt and that of both faces together.
std::vector<ComparedField> charging_currents(const CheckInput& input, const ComparisonPoints& at);

/// Stored fields that the electric problem determines: q and f_E, with displacement currents also V_m.
std::vector<ComparedField> stored_electric_fields(const CheckInput& input, const ComparisonPoints& at);

/// V_m of the snapshot against that which the elements advance from an earlier one.
/// @param input  must have in_time
ComparedField potential_in_time(const CheckInput& input, const ComparisonPoints& at, const ChargingLevels& charging);

/// Stored fields of the flow with the given force: v, and ∇_γ·v, computed here by differentiation and compared with the
/// constraint.
std::vector<ComparedField> stored_flow_fields(const CheckInput& input, const ComparisonPoints& at);

/// Stored fields determined by the shape: f_b and f_λ against the boundary integrals, their work and λ against the
/// finite elements if these provide them, otherwise λ against the boundary integrals.
/// @param of_shape  a level as in fields_of_shape(); null: none
std::vector<ComparedField> stored_fields_of_shape(const CheckInput& input, const ComparisonPoints& at,
                                                  const Level* of_shape);

}  // namespace vehd::fem_check
