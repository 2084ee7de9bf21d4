#pragma once

#include <vector>

#include "bie/linear/solve_report.hpp"

namespace vehd {

/// Samples of a linear map: columns of arguments and their images, newest first. The map may have changed since, the
/// more the older a column is.
struct RecycledSubspace {
  Matrix arguments;  ///< [length x count]
  Matrix responses;  ///< [length x count]

  [[nodiscard]] Index count() const { return arguments.cols(); }
};

/// The newer columns before the older ones, at most `most` of them.
RecycledSubspace joined(const RecycledSubspace& newer, const RecycledSubspace& older, Index most);

/// The columns with these numbers.
RecycledSubspace selected(const RecycledSubspace& known, const std::vector<Index>& columns);

/// Approximate inverse of an operator close to the identity from what is known of it, X ↦ Y:
///   r ↦ r + (X − Y)(YᵀY)⁻¹Yᵀ r.
/// It takes every known response to its argument and leaves alone what is orthogonal to all of them (the limited-memory
/// preconditioner of Gratton, Sartenaer, Tshimanga 2011 for an unsymmetric operator). Responses within 1e-4 of the span
/// of newer ones are left out; of the others the 96 newest are kept.
/// Accuracy: responses go to their arguments to 1e-12 (tests/linear/recycled_subspace_test.cpp)
class SecantInverse {
 public:
  SecantInverse() = default;
  /// The identity if `known` is empty.
  explicit SecantInverse(const RecycledSubspace& known);

  /// The formula above; the length of r is that of the arguments.
  [[nodiscard]] Vector apply(const Vector& r) const;
  /// Numbers of the columns of `known` that are used.
  [[nodiscard]] const std::vector<Index>& kept() const { return kept_; }

 private:
  std::vector<Index> kept_;
  Matrix responses_;   // Y, columns of norm 1
  Matrix difference_;  // X − Y, likewise scaled
  Matrix factor_;      // lower triangular L with YᵀY = L Lᵀ
};

}  // namespace vehd
