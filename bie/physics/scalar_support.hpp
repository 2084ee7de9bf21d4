#pragma once

#include <vector>

#include "bie/sphere/transform.hpp"

namespace vehd {

/// Which coefficients of a scalar field can differ from zero: those of m = 0 where the transform serves axisymmetric
/// fields (vectors have m = 0 and ±1 then, scalars do not); empty where all can.
std::vector<Index> scalar_support(const SphereTransform& transform);

}  // namespace vehd
