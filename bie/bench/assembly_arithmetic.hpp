#pragma once

#include <cstdint>
#include <vector>

#include "bie/potentials/layer_operators.hpp"

namespace vehd {

/// Floating-point operations of one assembly: matrix products, a multiplication and an addition counting one each, and
/// kernels, where a square root or a division also counts one. Arguments as in assemble_symmetric_operators.
/// Accuracy: a count of the loops as they are written; between orders 4.3 and 5 in p
/// (tests/bench/assembly_arithmetic_test.cpp)
double operations_per_assembly(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                               const LayerSelection& selection, const SymmetrySubspace& subspace, int fold);

}  // namespace vehd
