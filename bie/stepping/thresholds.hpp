#pragma once

#include <algorithm>
#include <cmath>

#include "bie/linear/thresholds.hpp"
#include "bie/support/types.hpp"

/// Numbers that set the accuracy of a step, or that several files use, each with its origin: derived or measured
/// (docs/thresholds.md). All other thresholds are in the file that uses them.
namespace vehd::thresholds {

/// Largest number of columns of each kind in a state: as many as a secant inverse can keep, and a third more to choose
/// from.
constexpr Index most_recycled = 4 * most_secant_columns / 3;

/// Variation of the distance from the centroid, over the radius, below which a membrane counts as a sphere. The
/// response to a uniform tension grows with its square: here it is 1e-10 of the response to any other tension, which
/// the solve cannot distinguish from its own tolerance.
constexpr double sphere_variation = 1e-5;

/// Strain left by former steps is taken back in full up to this value, partly above it, and not at all from twice this
/// value on: larger strains come from truncated degrees, and taking them back distorts the shape. Shape and tension do
/// not depend on the strain. Shipped scenes have at most a tenth of this. Measured (docs/accuracy.md).
constexpr double known_strain = 5e-3;

// Shares of the tolerance.

/// Estimated error allowed in one step: the errors of about three steps add up. Measured.
constexpr double step_share = 0.35;
/// Estimated error allowed in a state within the step. Measured.
constexpr double dense_output_share = 0.25;
/// Truncation error, and change of tension and charge at the start by two more degrees; the rest is for the step.
constexpr double truncation_share = 0.3;

// Steps with a tolerance.

/// Strongest contraction of corrections that is assumed. If a motion relaxes about once within a step,
/// its correction passes through zero in one sweep, and the next ones contract by 0.1 to 0.3. With 0.1 a membrane that
/// becomes taut is wrong by four tolerances, with 0.2 two spheres that approach each other take fifteen times as many
/// steps. Measured.
constexpr double best_contraction = 0.12;
/// The last step is extrapolated over at most this many times its own size. Measured.
constexpr double longest_extrapolation = 2.0;
/// Largest growth of the truncation error of a compressed membrane that is allowed for. Measured.
constexpr double most_growth = 30.0;
/// Smallest increase of a degree that is too low: the next degree has the other parity, which adds nothing to a shape
/// with mirror symmetry. A degree that is too high falls by at least twice as much: four degrees fewer than sixteen
/// halve the assembly.
constexpr int least_raise = 2;

// Contact.

/// Smallest ratio of the distances of two parts after and before a step once they are closer than the grid spacing: in
/// larger steps they could pass through each other undetected.
constexpr double least_approach = 0.5;
/// Gap between two vesicles over the radius down to which the layers between them are tested (PairLayers).
constexpr double smallest_gap = 1e-3;
/// Shortest range of a contact potential, over the radius, that grids of degree 256 resolve between smooth vesicles.
constexpr double shortest_contact = 0.02;
/// Degree that resolves the densities in a gap h, times √(h/radius). The distance of two curved membranes doubles over
/// a length √h, and densities vary over the same length: degree p leaves a relative error of about 10 exp(−1.6 p
/// √(h/radius)) in the velocity. Measured for spheres, at gaps from 0.04 to 0.2, against exact solutions
/// (tests/stepping/spheres_test.cpp).
/// @param tolerance  0: a fixed degree, of which 1e-2 is expected
inline double degrees_of_gap(double tolerance) {
  constexpr double of_fixed_degree = 1e-2;
  return std::log(10.0 / (tolerance > 0.0 ? std::min(tolerance, of_fixed_degree) : of_fixed_degree)) / 1.6;
}

}  // namespace vehd::thresholds
