#pragma once

#include <optional>

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// What can be told of the time to come without moving a membrane.
struct Outlook {
  double until = 0.0;            ///< a time up to which errors matter; infinite where none is known
  std::optional<double> jump{};  ///< when the forcing jumps, where that is earlier
  double delay = 0.0;            ///< how much later `soon` is
  /// The same shapes with V_m and the forcing as they will be; absent where nothing is compressed that charges.
  std::optional<SolvedFields> soon{};
  std::optional<SolvedFields> after_jump{};  ///< the same shapes and V_m with the forcing after the jump
};

/// Solves for what an outlook has, with the operators at hand.
/// @param solved  of the state
/// @param until   a time; infinite where none is known
/// @param delay   of about a step
/// Accuracy: what cannot be solved for is absent
Outlook look_ahead(const Model& model, const Discretisation& discretisation, const State& state,
                   const SolvedFields& solved, double until, double delay, Instruments& instruments);

/// By what is wrong with the shapes is expected to grow: at least 1.
struct ErrorGrowth {
  double steps = 1.0;    ///< of what steps leave, which has all degrees
  double degrees = 1.0;  ///< of what the degrees leave out, which the highest of those there are feel first
};

/// By what a small error of a shape is expected to grow: exp Σ σ_n T with the rates of disturbance_rate for the mean
/// tension before a jump and after it, of the degrees where each is largest and of the vesicle where the sum is. A
/// compression is expected to last until the membrane has moved by its own radius along its normal at the speed it has,
/// or until the end. How V_m and field change it says more: where that weakens it, it lasts until it would be gone at
/// that rate, with half its strength. A charge that saturates may deceive this, so thresholds::unsure_growth is
/// expected without it. After a jump of the forcing that is still to come the growth goes on from what the tension at
/// hand makes of an error until then; what the jump brings lasts until V_m has changed so much that its stress has
/// changed by all that it is.
///
/// @param solved  of the state
/// @return        1 where nothing is compressed, at most thresholds::most_growth_of_steps and _of_degrees
/// Accuracy: of a field-driven prolate ∫σ dt is 9.0 where errors grow by 1e4 = exp(9.2) (docs/thresholds.md); an
/// estimate for other shapes
/// Source: of this project
ErrorGrowth expected_growth(const Model& model, const Discretisation& discretisation, const State& state,
                            const SolvedFields& solved, const Outlook& outlook);

/// How long an error of a shape is remembered, of the vesicle that remembers longest: until its points have moved by
/// the radius, at the root mean square of their speed, and no longer than until that time. 0 where shapes are frozen.
/// Accuracy: an estimate; errors of a treading prolate add up over that time within a factor of two
/// (docs/thresholds.md) Source: of this project
double memory_of_shapes(const Model& model, const State& state, const SolvedFields& solved, double until);

}  // namespace vehd
