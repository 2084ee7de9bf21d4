#pragma once

#include "bie/physics/parameters.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// Degree, on a sphere of this radius, of the wrinkles that grow fastest on a compressed membrane: a plane membrane
/// under the tension λ < 0 amplifies disturbances of wavenumber k at the rate (|λ| k − κ_c k³)/(2(μ_i + μ_e)), with
/// κ_c = κ_B/2, so those of k = √(2|λ|/(3κ_B)) grow fastest. 0 without compression, infinite without bending.
/// @param least_tension  the most negative λ on the membrane
/// Accuracy: exact for the formula (tests/stepping/evaluation/wrinkling_test.cpp); an estimate for curved membranes
double wrinkle_degree(const FlowParameters& parameters, double least_tension, double radius);

/// Growth rate of the fastest disturbance, of degree 2 to the highest, of a nearly spherical membrane under a uniform
/// tension; 0 if all of them decay. The rate of degree n is
///
///   σ_n = −κ_c (n−1) n (n+1) (n+2) [n(n+1) + λR²/κ_c] / (μ_e R³ [(2n³+3n²−5) μ_i/μ_e + 2n³+3n²+4]),  κ_c = κ_B/2.
///
/// For n → ∞ it is that of a plane membrane with k = n/R.
/// @param tension  λ, the mean of the membrane
/// [1/time]
/// Accuracy: exact for the formula (tests/stepping/evaluation/wrinkling_test.cpp)
/// Source: friction as in the quasi-spherical theory of Vlahovska and Gracia (docs/references.md)
double wrinkling_rate(const FlowParameters& parameters, double tension, double radius, int highest_degree);

/// Expected growth of a small error of a shape while the shape changes completely: the factor exp(σ R/v), with σ the
/// wrinkling_rate of the mean tension and v the largest speed of a membrane along its normal; the largest of all
/// vesicles.
/// @param solved  of the state
/// @return        1 without compression, at most thresholds::most_growth
/// Accuracy: an estimate
double growth_of_wrinkles(const Model& model, const State& state, const SolvedFields& solved);

}  // namespace vehd
