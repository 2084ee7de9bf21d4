#pragma once

#include <cstddef>

/// Thresholds of the solvers with recycling, each derived or measured (docs/thresholds.md).
namespace vehd::thresholds {

/// Rounding error of a map and its preconditioner, relative to their arguments and results: the layers sum a few
/// thousand products, whose errors have either sign and grow with the square root of their number, times 2e-16.
constexpr double map_rounding = 1e-14;

/// A proposal whose image has the cosine c with the residual leaves √(1 − c²) of it. The plain residual as proposal
/// leaves at most δ if the preconditioned map is within δ of the identity. Samples of another operator can give poor
/// proposals: below this cosine more than 0.6 is left, no better than with the plain residual at δ = 0.6, which is then
/// the next proposal. So at most every other iteration is lost.
constexpr double least_share_of_recycled = 0.8;

/// The plain residual fails as a proposal if the map turns it by a right angle. A cosine of 1e-3 reduces the residual
/// by less than 1e-6, too little for one digit in any practical number of iterations; the Krylov space is then extended
/// by the last image.
constexpr double least_share_of_residual = 1e-3;

/// Largest difference between the stored image of a direction, of norm 1, and the image of its x: the rounding error of
/// the proposals, amplified by orthogonalisation. A step fails to remove this fraction of what the recursive residual
/// subtracts. Computing the true residual reveals it at the cost of one application, so that six digits suffice (with
/// eight, stiff first-order steps, κ_B dt = 10 at degree 32, find no direction on some processors).
constexpr double most_uncertain_direction = 1e-6;
/// Tighter bound after the true residual has not decreased: nearly dependent directions fail again with six digits, but
/// not with seven.
constexpr double most_uncertain_after_misleading = 3e-8;

/// The search makes progress if the true residual has halved since it was last computed.
constexpr double gain_between_looks = 0.5;

/// Largest number of columns of a secant inverse. Measured: half as many take seven percent more iterations in
/// tank-treading; twice as many save less than one percent and cost twice the products.
constexpr std::size_t most_secant_columns = 96;

/// A response within this distance of the span of newer ones, relative to its norm, adds only rounding: its
/// coefficients would be 1e4 times as large. Measured: the iterations summed over scenes agree within a percent from
/// 1e-5 to 1e-3.
constexpr double least_independence = 1e-4;

}  // namespace vehd::thresholds
