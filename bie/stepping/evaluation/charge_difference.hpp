#pragma once

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// How much q, or its amplitude in an averaged field, of one state differs between two evaluations at different
/// degrees: the largest difference at the nodes of the second over charge_scale, the largest of all vesicles; 0 without
/// a field.
/// @param discretisation  of the second
double charge_difference(const Model& model, const Discretisation& discretisation, const Evaluation& first,
                         const Evaluation& second);

}  // namespace vehd
