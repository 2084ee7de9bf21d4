#pragma once

#include <vector>

#include "fem_check/app/charging_levels.hpp"
#include "fem_check/app/question_maker.hpp"

/// One row of the table for each question.
namespace vehd::fem_check {

/// The fields of the electric problem: q, Vm, q_steady, force and φ at the sample points.
std::vector<FieldQuestion> electric_questions(const CheckInput& input, const ComparisonPlaces& places,
                                              const LevelSequence& sequence);

/// The fields of the flow without the background flow: velocity, velocity_own_force and v at the sample points.
std::vector<FieldQuestion> flow_questions(const CheckInput& input, const ComparisonPlaces& places,
                                          const LevelSequence& sequence);

/// Fields that follow from the shape, V_m and the physics alone: f_b, tension and velocity, the last without the
/// background flow; those that the elements have.
/// @param of_shape  a level of them
std::vector<FieldQuestion> shape_questions(const CheckInput& input, const ComparisonPlaces& places,
                                           const Level& of_shape);

/// Currents that charge the membrane, of the given V_m or charges: C dV_m/dt, or dq_i/dt and that of both faces.
std::vector<FieldQuestion> current_questions(const CheckInput& input, const ComparisonPlaces& places);

/// Numbers of the snapshot that the electric problem determines: q and f_E, with displacement currents V_m.
std::vector<FieldQuestion> stored_electric_questions(const CheckInput& input, const ComparisonPlaces& places);

/// V_m of the snapshot, by what the elements advance from an earlier one.
/// @param input  with in_time
FieldQuestion in_time_question(const CheckInput& input, const ComparisonPlaces& places, const ChargingLevels& charging);

/// Numbers of the snapshot that belong to the flow of the given force: v, and ∇_γ·v by what the boundary integrals
/// leave of it, by derivatives of this side.
std::vector<FieldQuestion> stored_flow_questions(const CheckInput& input, const ComparisonPlaces& places);

/// Numbers of the snapshot that follow from its shape: f_b and f_λ by what the boundary integrals find, their work and
/// λ by the finite elements where these have them, λ by the boundary integrals elsewhere.
/// @param of_shape  a level of shape_questions(); null: none
std::vector<FieldQuestion> stored_shape_questions(const CheckInput& input, const ComparisonPlaces& places,
                                                  const Level* of_shape);

}  // namespace vehd::fem_check
