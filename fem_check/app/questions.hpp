#pragma once

#include <vector>

#include "fem_check/app/charging_levels.hpp"
#include "fem_check/app/question_maker.hpp"

/// Questions of a check, one for each row of the table.
namespace vehd::fem_check {

/// Fields of the electric problem: q, Vm, q_steady, force and φ at the sample points.
std::vector<FieldQuestion> electric_questions(const CheckInput& input, const ComparisonPlaces& places,
                                              const LevelSequence& sequence);

/// Fields of the flow without the background flow: velocity, velocity_own_force and v at the sample points.
std::vector<FieldQuestion> flow_questions(const CheckInput& input, const ComparisonPlaces& places,
                                          const LevelSequence& sequence);

/// Fields determined by shape, V_m and material parameters: f_b, f_c of a spontaneous curvature, tension, and velocity
/// without the background flow; only those that the elements provide.
/// @param of_shape  a level with these fields
std::vector<FieldQuestion> shape_questions(const CheckInput& input, const ComparisonPlaces& places,
                                           const Level& of_shape);

/// Currents that charge the membrane for given V_m or charges: C dV_m/dt, or dq_i/dt and that of both faces together.
std::vector<FieldQuestion> current_questions(const CheckInput& input, const ComparisonPlaces& places);

/// Stored fields that the electric problem determines: q and f_E, with displacement currents also V_m.
std::vector<FieldQuestion> stored_electric_questions(const CheckInput& input, const ComparisonPlaces& places);

/// V_m of the snapshot against that which the elements advance from an earlier one.
/// @param input  must have in_time
FieldQuestion in_time_question(const CheckInput& input, const ComparisonPlaces& places, const ChargingLevels& charging);

/// Stored fields of the flow with the given force: v, and ∇_γ·v, computed here by differentiation and compared with the
/// constraint.
std::vector<FieldQuestion> stored_flow_questions(const CheckInput& input, const ComparisonPlaces& places);

/// Stored fields determined by the shape: f_b and f_λ against the boundary integrals, their work and λ against the
/// finite elements if these provide them, otherwise λ against the boundary integrals.
/// @param of_shape  a level as in shape_questions(); null: none
std::vector<FieldQuestion> stored_shape_questions(const CheckInput& input, const ComparisonPlaces& places,
                                                  const Level* of_shape);

}  // namespace vehd::fem_check
