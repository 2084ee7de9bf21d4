#pragma once

#include "bie/physics/parameters.hpp"

namespace vehd {

/// Degree, on a sphere of this radius, of the wrinkles that grow fastest on a compressed membrane: a plane membrane
/// under the tension λ < 0 amplifies disturbances of wavenumber k at the rate (|λ| k − κ_c k³)/(2(μ_i + μ_e)), with
/// κ_c = κ_B/2, hence those of k = √(2|λ|/(3κ_B)) most. 0 where nothing is compressed, infinite without bending.
/// @param least_tension  the most negative λ on the membrane
/// Accuracy: exact for the formula (tests/stepping/evaluation/wrinkling_test.cpp); an estimate for curved membranes
double wrinkle_degree(const FlowParameters& parameters, double least_tension, double radius);

}  // namespace vehd
