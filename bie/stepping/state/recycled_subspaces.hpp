#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bie/linear/recycled_subspace.hpp"
#include "bie/support/ranks/parcel.hpp"

namespace vehd {

/// A recycled subspace of a map between scalars of one membrane, with the coefficients that its rows represent. A solve
/// in other coefficients, after a change of degree or symmetry, gets an empty one.
class RecycledScalars {
 public:
  /// @param entries  coefficient_index of the rows of each scalar, ascending; the scalars stand one below the other
  /// @throws ShapeError unless the rows are those of whole scalars
  RecycledScalars(std::vector<Index> entries, RecycledSubspace subspace);

  /// The subspace if its rows are these coefficients of n_scalars scalars, else an empty one. Truncated or padded to
  /// another degree, responses no longer match their arguments, because degrees are coupled, and solves take more
  /// iterations with recycling than without (25 instead of 19 from degree 10 down to 8, 18 instead of 12 up to 13; 11
  /// instead of 18 at the same degree: a sheared 2 : 1 : 0.9 ellipsoid).
  [[nodiscard]] RecycledSubspace in(const std::vector<Index>& entries, Index n_scalars) const;

  [[nodiscard]] const std::vector<Index>& entries() const { return entries_; }
  [[nodiscard]] const RecycledSubspace& subspace() const { return subspace_; }

 private:
  std::vector<Index> entries_;
  RecycledSubspace subspace_;
};

/// Null where the subspace is empty.
std::shared_ptr<const RecycledScalars> recycled_scalars(const std::vector<Index>& entries, RecycledSubspace subspace);

/// RecycledScalars in a message between ranks.
struct SentScalars {
  std::shared_ptr<const RecycledScalars> known;  ///< or null
};

void visit_members(const SentScalars& sent, Packing& packing);
void visit_members(SentScalars& sent, Unpacking& unpacking);

/// Samples that velocity solves recycle, in the coefficients that the symmetry leaves; null: none. The next step can
/// use the directions of this one because its operators are nearly the same.
struct RecycledSubspaces {
  std::shared_ptr<const RecycledScalars> tension;  ///< λ ↦ J ∇_γ·u
  std::shared_ptr<const RecycledScalars> flow;     ///< (h, λ) ↦ (Hop(u), J ∇_γ·u), see FlowScalars
  std::int64_t unaided_iterations = 0;             ///< of the last step without `flow`
  std::int64_t pause = 0;                          ///< steps left until `flow` is kept again
};

/// The samples to recycle after a step. On grids with badly placed poles the flow can take more iterations with
/// recycling than without: after more than twice as many as in the last step without, the next steps do not recycle.
/// @param flow        samples of the step for its successor
/// @param iterations  of the flow solves of the step
RecycledSubspaces after_step(const RecycledSubspaces& before, std::shared_ptr<const RecycledScalars> flow,
                             int iterations);

}  // namespace vehd
