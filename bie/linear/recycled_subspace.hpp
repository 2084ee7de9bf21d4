#pragma once

#include <vector>

#include "bie/linear/solve_report.hpp"

namespace vehd {

/// Samples of a linear map: columns of arguments and their images, newest first. The map may have changed since a
/// column was sampled.
struct RecycledSubspace {
  Matrix arguments;  ///< [length x count]
  Matrix responses;  ///< [length x count]

  [[nodiscard]] Index count() const { return arguments.cols(); }
};

/// The newer columns followed by the older ones, at most `most` in total; `older` unchanged if there are no newer ones.
RecycledSubspace joined(const RecycledSubspace& newer, const RecycledSubspace& older, Index most);

/// The columns with these indices.
RecycledSubspace selected(const RecycledSubspace& known, const std::vector<Index>& columns);

/// Approximate inverse of an operator close to the identity from samples X ↦ Y of it:
///   r ↦ r + (X − Y)(YᵀY)⁻¹Yᵀ r.
/// It maps every response to its argument and leaves vectors orthogonal to all responses unchanged (the limited-memory
/// preconditioner of Gratton, Sartenaer, Tshimanga 2011 for an unsymmetric operator). Responses within 1e-4 of the span
/// of newer ones are dropped; the 96 newest of the others are kept.
/// Accuracy: responses are mapped to their arguments to 1e-12 (tests/linear/recycled_subspace_test.cpp)
class SecantInverse {
 public:
  SecantInverse() = default;
  /// The identity if `known` is empty.
  explicit SecantInverse(const RecycledSubspace& known);

  /// Applies the formula above to r, [size], as long as the arguments.
  [[nodiscard]] Vector apply(const Vector& r) const;
  /// Indices of the columns of `known` that are used.
  [[nodiscard]] const std::vector<Index>& kept() const { return kept_; }

 private:
  std::vector<Index> kept_;
  Matrix responses_;   // Y, columns of norm 1
  Matrix difference_;  // X − Y, scaled as Y
  Matrix factor_;      // lower triangular L with YᵀY = L Lᵀ
};

}  // namespace vehd
