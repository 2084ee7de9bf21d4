#pragma once

#include <cstdint>
#include <memory>

#include "bie/linear/known_responses.hpp"

namespace vehd {

/// Columns of each kind that a state carries at most.
constexpr Index most_known_responses = 128;

/// What velocity solves have learned of their operators, in the coefficients that the symmetry leaves; nothing known:
/// null. Directions that served one step serve the next, whose operators are nearly the same.
struct FlowMemory {
  std::shared_ptr<const KnownResponses> tension;  ///< λ ↦ J ∇_γ·u
  std::shared_ptr<const KnownResponses> flow;     ///< (h, λ) ↦ (Hop(u), J ∇_γ·u), see FlowRightHandSide
  std::int64_t unaided_iterations = 0;            ///< of the last step that nothing of `flow` was known for
  std::int64_t pause = 0;                         ///< steps to go until `flow` is kept again
};

/// The memory after a step. On grids with poles in bad places the flow takes more iterations with what is known than
/// without: where it took more than twice as many as the last unaided step, the next steps go without it.
/// @param known       what the step leaves known of the flow
/// @param iterations  of the step
FlowMemory memory_after_step(const FlowMemory& before, std::shared_ptr<const KnownResponses> known, int iterations);

}  // namespace vehd
