#pragma once

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// By what a small error of a shape is expected to grow until the shape is another one: exp(σ R/v), with σ the
/// wrinkling_rate of the mean tension and v the largest speed of a membrane along its normal; of the vesicle where it
/// is largest.
/// @param solved  of the state
/// @return        1 where nothing is compressed, at most thresholds::most_growth
/// Accuracy: an estimate
double growth_of_wrinkles(const Model& model, const State& state, const SolvedFields& solved);

}  // namespace vehd
