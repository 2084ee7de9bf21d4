#pragma once

#include <cstddef>

/// Numbers that decide something in the solvers with recycling, each with its origin: derived, or measured
/// (docs/thresholds.md).
namespace vehd::thresholds {

/// Rounding of the sums of a map and its preconditioner, relative to their arguments and results: the layers sum a few
/// thousand products, and errors of either sign add up like their square root, times 2e-16.
constexpr double map_rounding = 1e-14;

/// Along a proposal that shares c with the residual, √(1 − c²) of it is left. The plain residual leaves at most δ where
/// the preconditioned map is within δ of the identity. What is known of another operator may mislead: where its share
/// is less than this it leaves 0.6 and more, no better than nothing known at δ = 0.6, and the plain residual is the
/// next direction; so at most every other iteration is lost.
constexpr double least_share_of_recycled = 0.8;

/// The plain residual fails where the map turns it by a right angle. A share of a thousandth removes less than a
/// millionth, which no number of iterations that anybody allows adds up to a digit; the Krylov space then grows by the
/// last image.
constexpr double least_share_of_residual = 1e-3;

/// The rounding of the proposals, magnified as what they have in common is taken out, is the part of a direction's
/// image, of norm 1, that its x does not have. A step leaves that part of the residual which it claims to remove, and
/// the look at the true residual finds it: what is lost is an application, so six digits are enough to be worth one
/// (with eight, stiff first-order steps, κ_B dt = 10 at degree 32, find no direction at all on some processors).
constexpr double most_uncertain_direction = 1e-6;
/// After a look that found no gain, directions have to be better than those that misled the search: nearly dependent
/// ones go on misleading with six digits and do not with seven.
constexpr double most_uncertain_after_misleading = 3e-8;

/// A look at the true residual that finds it halved since the last one has found the search on its way.
constexpr double gain_between_looks = 0.5;

/// Columns that a secant inverse keeps. Measured: half as many take seven percent more iterations in tank-treading,
/// twice as many save less than one and cost twice the products.
constexpr std::size_t most_secant_columns = 96;

/// A response that lies within this of the span of newer ones, relative to its norm, says nothing new but rounding: its
/// coefficients would be 1e4 times as large. Measured: the sum over scenes is the same within a percent from 1e-5 to
/// 1e-3.
constexpr double least_independence = 1e-4;

}  // namespace vehd::thresholds
