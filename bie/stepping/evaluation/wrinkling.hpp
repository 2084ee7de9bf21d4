#pragma once

#include "bie/physics/parameters.hpp"

namespace vehd {

/// Degree, on a sphere of this radius, of the wrinkles that grow fastest on a compressed membrane: a plane membrane
/// under the tension λ < 0 amplifies disturbances of wavenumber k at the rate (|λ| k − κ_c k³)/(2(μ_i + μ_e)), with
/// κ_c = κ_B/2, hence those of k = √(2|λ|/(3κ_B)) most. 0 where nothing is compressed, infinite without bending.
/// @param least_tension  the most negative λ on the membrane
/// Accuracy: exact for the formula (tests/stepping/evaluation/wrinkling_test.cpp); an estimate for curved membranes
double wrinkle_degree(const FlowParameters& parameters, double least_tension, double radius);

/// Rate at which a disturbance of degree n ≥ 2 of a nearly spherical membrane under a uniform tension grows, negative
/// where it decays:
///
///   σ_n = −κ_c (n−1) n (n+1) (n+2) [n(n+1) + λR²/κ_c] / (μ_e R³ [(2n³+3n²−5) μ_i/μ_e + 2n³+3n²+4]),  κ_c = κ_B/2.
///
/// For n → ∞ it is that of a plane membrane with k = n/R.
/// @param tension  λ, the mean of the membrane
/// [1/time]
/// Accuracy: exact for the formula (tests/stepping/evaluation/wrinkling_test.cpp)
/// Source: friction as in the quasi-spherical theory of Vlahovska and Gracia (docs/references.md)
double disturbance_rate(const FlowParameters& parameters, double tension, double radius, int degree);

/// That of the fastest of the degrees from 2 to the highest; 0 where all of them decay. [1/time]
double wrinkling_rate(const FlowParameters& parameters, double tension, double radius, int highest_degree);

}  // namespace vehd
