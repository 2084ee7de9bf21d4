#pragma once

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// By what a small error of a shape is expected to grow until a time: exp(σ T) with the rate σ at which the fastest
/// disturbance of a compressed membrane grows now, wrinkling_rate of its mean tension and of the degrees that the
/// membrane has, of the vesicle where that is largest. T ends at that time, or where the membrane has moved by its own
/// radius along its normal at the speed it has: what compresses it then is another matter. A membrane that wrinkles
/// more finely than any degree allowed can show is left out: what grows there is what was cut off, and a smaller
/// allowance brings degrees that let it grow faster.
///
/// @param evaluation      of the state
/// @param until           a time; infinite where none is known
/// @param highest_degree  that the membranes may have
/// @return                between 1, where nothing is compressed, and thresholds::most_growth
/// Accuracy: of a field-driven prolate ∫σ dt is 9.0 where errors grow by 1e4 = exp(9.2) (docs/thresholds.md); an
/// estimate for other shapes
/// Source: of this project
double expected_growth(const Model& model, const Discretisation& discretisation, const State& state,
                       const Evaluation& evaluation, double until, int highest_degree);

}  // namespace vehd
