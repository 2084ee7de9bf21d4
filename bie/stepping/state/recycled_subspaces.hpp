#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bie/linear/recycled_subspace.hpp"
#include "bie/support/ranks/parcel.hpp"

namespace vehd {

/// A recycled subspace of a map between scalars of one membrane, together with the coefficients that its rows stand
/// for. A solve in other coefficients, after a change of degree or symmetry, finds it empty.
class RecycledScalars {
 public:
  /// @param entries  coefficient_index of the rows of each scalar, ascending; the scalars stand one below the other
  /// @throws ShapeError unless the rows are those of whole scalars
  RecycledScalars(std::vector<Index> entries, RecycledSubspace subspace);

  /// The subspace, if it is one in these coefficients of n_scalars scalars; else an empty one. Cut to another degree or
  /// continued by zeros, responses are those of their arguments only up to what the degrees between them do to each
  /// other, and solves take more iterations with them than without (25 for 19 down from degree 10 to 8, 18 for 12 up to
  /// 13; 11 for 18 at the same degree: a sheared 2 : 1 : 0.9 ellipsoid).
  [[nodiscard]] RecycledSubspace in(const std::vector<Index>& entries, Index n_scalars) const;

  [[nodiscard]] const std::vector<Index>& entries() const { return entries_; }
  [[nodiscard]] const RecycledSubspace& subspace() const { return subspace_; }

 private:
  std::vector<Index> entries_;
  RecycledSubspace subspace_;
};

/// Null where the subspace is empty.
std::shared_ptr<const RecycledScalars> recycled_scalars(const std::vector<Index>& entries, RecycledSubspace subspace);

/// As ranks send it.
struct SentScalars {
  std::shared_ptr<const RecycledScalars> known;  ///< or null
};

void visit_members(const SentScalars& sent, Packing& packing);
void visit_members(SentScalars& sent, Unpacking& unpacking);

/// Samples that velocity solves recycle, in the coefficients that the symmetry leaves; null: none. Directions of one
/// step serve the next, whose operators are nearly the same.
struct RecycledSubspaces {
  std::shared_ptr<const RecycledScalars> tension;  ///< λ ↦ J ∇_γ·u
  std::shared_ptr<const RecycledScalars> flow;     ///< (h, λ) ↦ (Hop(u), J ∇_γ·u), see FlowScalars
  std::int64_t unaided_iterations = 0;             ///< of the last step without `flow`
  std::int64_t pause = 0;                          ///< steps to go until `flow` is kept again
};

/// The samples to recycle after a step. On grids with poles in bad places the flow takes more iterations with recycling
/// than without: where it took more than twice as many as the last step without, the next ones go without it.
/// @param flow        that the step leaves for velocity solves
/// @param iterations  of the step
RecycledSubspaces after_step(const RecycledSubspaces& before, std::shared_ptr<const RecycledScalars> flow,
                             int iterations);

}  // namespace vehd
