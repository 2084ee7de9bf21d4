#pragma once

#include <vector>

#include "bie/comparison/check_fields.hpp"

namespace vehd {

/// check_fields for several vesicles, coupled as a run couples them; nothing at sample points.
/// @param forces  total_force of the stored fields of each
/// @param orders  of each
/// @throws ConvergenceError where a solve fails
/// Accuracy: spectral in the orders; the comparison takes the difference of two of them for its error (docs/check.md)
/// Source: paper Eqs. (5), (11), (12), (14), the layers being those of all membranes
std::vector<CheckFields> coupled_check_fields(const FrozenState& frozen, const CheckContents& contents,
                                              const std::vector<Matrix>& forces, const std::vector<int>& orders);

}  // namespace vehd
