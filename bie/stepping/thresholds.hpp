#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bie/linear/thresholds.hpp"
#include "bie/support/types.hpp"

/// Numbers that decide something in a step, each with its origin: derived, or measured (docs/thresholds.md).
namespace vehd::thresholds {

// Recycling between steps, see RecycledSubspaces.

/// Columns of each kind that a state carries at most: those that a secant inverse can keep and a third more to choose
/// from.
constexpr Index most_recycled = 4 * most_secant_columns / 3;
/// A step that takes this many times the iterations of one without recycling is slowed down by it. Measured.
constexpr double slowed_by_recycling = 2.0;
/// Steps until recycling is tried again: at two steps in fifty a useless trial costs a few percent of a run. Measured.
constexpr std::int64_t steps_without_recycling = 50;

// The solve for (h, λ), Eq. (27).

/// Strain counts in the norm of the joint system by this share of what the change of curvature does: the tolerance of
/// the one over that of the other (NumericalSettings). Measured.
constexpr double strain_share = 0.1;
/// Variation of the distance from the centroid, over the radius, below which a membrane is a sphere. What a uniform
/// tension moves grows with the square of it: 1e-10 of what any other tension does, which the solve cannot tell from
/// its own tolerance.
constexpr double sphere_variation = 1e-5;
/// Iterations of one solve. Without a preconditioner of the right shape (1 : 1 : 5, degree 64) sixty are needed.
constexpr int most_flow_iterations = 120;

/// Sizes whose systems a step keeps: twice as many as the nodes of a scheme ask for. Moments within a step have sizes
/// of their own that never come again.
constexpr std::size_t most_flow_systems = 12;

// The passes of a motion, see constrained_motion.

/// A pass that converges reduces its residual by the square or by its own tolerance: ten are a tenth of a digit each.
constexpr int most_passes = 24;
/// Relative tolerance of a pass. Every pass starts from the full residual, so it needs no more digits than its
/// linearisation is worth (a step changes the shape by about a hundredth), nor more than are left to gain. Measured.
constexpr double finest_pass = 1e-2;
constexpr double loosest_pass = 0.3;
/// A pass that leaves more than this of its residual does not gain.
constexpr double stagnation_ratio = 0.9;
/// So many may happen in a step that arrives all the same. After each further one passes are solved with this share of
/// their tolerance, and not below the sharpest: the norm of the solve counts Eq. (28) at degree 64 a few thousandths of
/// what it does at degree 1.
constexpr int stagnating_passes = 4;
constexpr double sharper_pass = 0.1;
constexpr double sharpest_pass = 1e-5;
/// Changes of H smaller than this, relative to H, are those of a shape at rest: Eq. (28) to five digits of them is
/// below what the constraint lets pass.
constexpr double curvature_floor = 1e-6;
/// Largest relative change of an area element that a motion may make before it is corrected: beyond a half the
/// linearised constraint can turn an element over.
constexpr double largest_stretch = 0.5;
/// Strain of former steps is taken back while it is no more than this, less and less of it above, and none from twice
/// this on: so much comes from degrees that are cut off, and asking for it back distorts the shape, which with its
/// tension does not depend on it. Shipped scenes have a tenth of this at most. Measured (docs/accuracy.md).
constexpr double known_strain = 5e-3;

// Time.

/// A disturbance that relaxes by more than all of it in one explicit step overshoots. The first-order step leaves
/// explicit the tension under which a disturbance of a sphere relaxes by this share, and holds the rest.
constexpr double explicit_relaxation = 0.5;
/// A potential without a field that is this small over |E|R has decayed: its stress, its square, is below rounding.
constexpr double decayed_potential = 1e-10;
/// Size of the next step over the one that would be just good enough: the estimate is of the leading order alone, and a
/// step that fails costs two sweeps or more. Measured.
constexpr double step_safety = 0.75;
/// A step changes its size by these factors at most.
constexpr double least_step_factor = 0.2;
constexpr double most_step_factor = 4.0;
/// And one that was not good enough is repeated in this share of its size at most.
constexpr double most_after_rejection = 0.9;
/// Tries that begin with the extrapolation of the last step, which may be what is wrong: a jump that nobody has told
/// of.
constexpr int most_tries_from_past = 2;
/// Share of the tolerance that one step may leave by its estimate: those of about three steps add up. Measured.
constexpr double step_share = 0.35;
/// What a degree leaves out of a compressed membrane is expected to grow by this at most. Measured.
constexpr double most_growth = 30.0;
/// Share of the tolerance that what is found within a step may be wrong by. Measured.
constexpr double moment_share = 0.25;
/// Share of the tolerance that the degrees left out may make up, and what two more change of the charge at the start:
/// the rest is that of the step.
constexpr double truncation_share = 0.3;
/// The first step covers this share of the time in which the start changes by the tolerance's root.
constexpr double first_step_share = 0.5;
/// From one derivative of a motion to the next, with the time over the step, no more than this is continued: what grows
/// faster is a jump. Measured.
constexpr double largest_derivative_ratio = 8.0;
/// Corrections that seem to contract more than this are not believed. Where a motion relaxes about once within a step
/// its correction passes through zero in one sweep, and the next ones contract by 0.1 to 0.3. With 0.1 a membrane that
/// becomes taut is wrong by four tolerances, with 0.2 two spheres that approach each other take fifteen times as many
/// steps. Measured.
constexpr double best_contraction = 0.12;
/// The last step is extrapolated to a time at most this many times as far away as it began. Measured.
constexpr double longest_continuation = 2.0;

/// Entries of the Stokes layers up to which threads have a state each, nodes of the step or snapshots within it. What
/// is larger keeps all of them busy with one, and two would not fit the caches. Measured.
constexpr double most_entries_of_small_operators = 1e6;

// Where the grid is moved to, see remap.

/// Sliding of degree n by an angle a is undone up to n a of this: a wave that slides past by a quarter of its length
/// (π/2) is no longer followed by one step along great circles.
constexpr double largest_phase = 1.5;
/// How sharply degrees fade out there: half at the phase, a thousandth at 2.4 times it.
constexpr int phase_power = 8;
/// Sliding below this is rounding.
constexpr double no_sliding = 1e-13;

// Degree and quadrature.

/// Errors of V_m, tension and q are relative to their size, but at least to this share of |E|R, κ_B/R² and η|E|, so
/// that a small V_m at the start of charging need not be known to all its digits.
constexpr double least_size = 0.1;
/// Slowest decay of a spectrum from degree to degree that a geometric series continues: slower ones do not decay within
/// any degree that vehd has (0.97 to the power 64 is a seventh).
constexpr double slowest_decay = 0.97;
/// Share of the target of x and V_m below which a lower degree is idle: far enough that the degree does not rise again
/// at once.
constexpr double idle_truncation = 0.1;
/// What the layers between vesicles may lose, as a share of the tolerance of the quadrature: they never decide how
/// exact a run is.
constexpr double pair_share = 1e-3;
/// Nodes of the singular quadrature at each level, relative to those of the settings. Between two levels its error
/// falls by two digits and more.
inline constexpr std::array quadrature_levels = {1.0, 1.75, 2.6};
/// Share of the tolerance of the quadrature below which a coarser level, two digits worse, would still do.
constexpr double idle_quadrature = 1e-2;
/// Errors of the layers up to this many times what truncation does to them are hidden by it.
constexpr double above_truncation = 3.0;
/// Degrees by which one that is too low rises at least: the next one is of the other parity, which adds nothing to a
/// shape that has mirrors. One that is too high falls by twice as many at least: four of sixteen are half of the
/// assembly.
constexpr int least_raise = 2;
/// Steps between two attempts to save work: one that fails every time costs little of what a run does.
constexpr std::int64_t economy_interval = 4;

// Contact.

/// Distance of two parts of a membrane, in grid spacings, at which D has lost all but two digits on the finest level.
constexpr double contact = 0.1;
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
