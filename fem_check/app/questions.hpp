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

/// What follows from the shape, V_m and the physics alone: f_b, tension and velocity, the last without the background
/// flow.
std::vector<FieldQuestion> shape_questions(const CheckInput& input, const ComparisonPlaces& places);

/// Numbers of the snapshot that the electric problem determines: q, f_E and the charging current.
std::vector<FieldQuestion> stored_electric_questions(const CheckInput& input, const ComparisonPlaces& places);

/// V_m of the snapshot, by what the elements advance from an earlier one.
/// @param input  with in_time
FieldQuestion in_time_question(const CheckInput& input, const ComparisonPlaces& places, const ChargingLevels& charging);

/// Numbers of the snapshot that belong to the flow: v by the finite elements; f_b, f_λ, λ and ∇_γ·v by what the
/// boundary integrals find for the shape, the last by derivatives of this side.
std::vector<FieldQuestion> stored_flow_questions(const CheckInput& input, const ComparisonPlaces& places);

}  // namespace vehd::fem_check
