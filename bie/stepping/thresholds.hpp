#pragma once

#include "bie/linear/thresholds.hpp"
#include "bie/support/types.hpp"

/// Numbers that set how exact a step is, or that several files use, each with its origin: derived, or measured
/// (docs/thresholds.md). All others stand in the file that uses them.
namespace vehd::thresholds {

/// Columns of each kind that a state carries at most: those that a secant inverse can keep and a third more to choose
/// from.
constexpr Index most_recycled = 4 * most_secant_columns / 3;

/// Variation of the distance from the centroid, over the radius, below which a membrane is a sphere. What a uniform
/// tension moves grows with the square of it: 1e-10 of what any other tension does, which the solve cannot tell from
/// its own tolerance.
constexpr double sphere_variation = 1e-5;

/// Strain of former steps is taken back while it is no more than this, less and less of it above, and none from twice
/// this on: so much comes from degrees that are cut off, and asking for it back distorts the shape, which with its
/// tension does not depend on it. Shipped scenes have a tenth of this at most. Measured (docs/accuracy.md).
constexpr double known_strain = 5e-3;

// Shares of the tolerance.

/// Estimated error allowed to one step: the errors of about three steps add up. Measured.
constexpr double step_share = 0.35;
/// The error of a state within the step. Measured.
constexpr double moment_share = 0.25;
/// Truncation error, and change of the charge at the start by two more degrees; the rest is for the step.
constexpr double truncation_share = 0.3;

// Steps with a tolerance.

/// Strongest contraction of corrections that is assumed. Where a motion relaxes about once within a step
/// its correction passes through zero in one sweep, and the next ones contract by 0.1 to 0.3. With 0.1 a membrane that
/// becomes taut is wrong by four tolerances, with 0.2 two spheres that approach each other take fifteen times as many
/// steps. Measured.
constexpr double best_contraction = 0.12;
/// The last step is extrapolated to a time at most this many times as far away as it began. Measured.
constexpr double longest_extrapolation = 2.0;
/// Largest growth of the truncation error of a compressed membrane that is allowed for. Measured.
constexpr double most_growth = 30.0;
/// Degrees by which one that is too low rises at least: the next one is of the other parity, which adds nothing to a
/// shape that has mirrors. One that is too high falls by twice as many at least: four of sixteen are half of the
/// assembly.
constexpr int least_raise = 2;

// Contact.

/// Two parts may come nearer by this factor in one step once they are closer than the grid spacing: with larger steps
/// they could pass through each other unseen.
constexpr double least_approach = 0.5;
/// Gap between two vesicles over the radius up to which the layers between them are tested (PairLayers).
constexpr double smallest_gap = 1e-3;
/// Ranges of a contact potential, over the radius, from which on grids of degree 256 see it between smooth vesicles.
constexpr double shortest_contact = 0.02;
/// Where two curved membranes are h apart their distance doubles over √h, and densities vary as fast: the degree that
/// follows them times √h, both over the radius.
constexpr double degrees_of_gap = 4.0;

}  // namespace vehd::thresholds
