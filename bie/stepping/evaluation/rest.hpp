#pragma once

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// The largest relative rate at which a state changes: its shapes (shape_rate); V_m, over the larger of its size and
/// |E|R, and charges and pores over their sizes, where the membrane is and not at material points, which may
/// tank-tread; the distance to a wall and the places of the vesicles relative to each other, over their radii.
/// 0 at rest.
/// @param state       of the evaluation
/// @param evaluation  with its membranes
/// Accuracy: values at the nodes of the upsampled grid
double largest_rate(const Model& model, const State& state, const Evaluation& evaluation);

}  // namespace vehd
