#pragma once

#include <vector>

#include "bie/support/types.hpp"

namespace vehd {

/// The six blocks xx, xy, xz, yy, yz, zz of a symmetric operator between vector fields, each of them symmetric between
/// its coefficients, of which every pair is kept once: half the memory that an application streams.
///
/// The single layer is symmetric, what the quadrature makes of it is so only up to the aliasing of high degrees: the
/// rotated rule resolves the product of a kernel with a smooth density, and the targets resolve what comes of it. So
/// an entry is taken from the finding of the higher degree by a density of the lower one; the other way round, rule and
/// targets would have to resolve a density of the higher degree. Between coefficients of one degree it is the mean of
/// both, so that turns of the sphere commute with the choice.
/// Accuracy: no entry that a smooth density meets is worse than before, the translating prolate keeps 4e-12 at p = 16
/// (tests/potentials/translating_prolate_test.cpp); symmetric to rounding (tests/potentials/stokes_identities_test.cpp)
class SymmetricBlocks {
 public:
  /// Coefficients that stand together in a column.
  static constexpr Index kGroup = 8;
  static constexpr int kBlocks = 6;

  SymmetricBlocks() = default;
  /// All columns are to be filled.
  /// @param degrees  of the coefficients, ascending
  explicit SymmetricBlocks(std::vector<int> degrees);

  [[nodiscard]] Index size() const { return static_cast<Index>(degrees_.size()); }
  /// Where the assembly puts what coefficient `out` finds of densities of its degree and lower ones:
  /// [groups][blocks][kGroup], finite numbers also where the last group is filled up.
  [[nodiscard]] double* column(Index out) { return values_.data() + starts_[static_cast<std::size_t>(out)]; }
  /// Coefficients whose densities the column of `out` has, the highest of the last degree.
  [[nodiscard]] Index n_in(Index out) const { return ends_[static_cast<std::size_t>(out)]; }
  /// Of a block in a column.
  [[nodiscard]] static Index place(int block, Index in) {
    return (in / kGroup * kBlocks + block) * kGroup + in % kGroup;
  }
  /// Values of a column with so many coefficients, groups filled up.
  [[nodiscard]] static Index filled(Index n_in) { return (n_in + kGroup - 1) / kGroup * kGroup * kBlocks; }
  /// The first coefficient of the group to which a place belongs.
  [[nodiscard]] static Index first_in(Index place) { return place / (kBlocks * kGroup) * kGroup; }
  /// Once all columns are there and before the first application.
  void symmetrize();

  /// Entry of a block, whichever is the larger index.
  [[nodiscard]] double at(int block, Index i, Index j) const;
  /// @param density  [size x 3] @return likewise
  [[nodiscard]] Matrix apply(const Matrix& density) const;

 private:
  /// Adds what the columns from the first to before the end contribute.
  void apply_columns(Index first, Index end, const RowMatrix& density, RowMatrix& sums) const;

  std::vector<int> degrees_;
  std::vector<Index> ends_;  ///< first coefficient of the next degree, for each
  std::vector<Index> starts_;
  Vector values_;  ///< columns one behind the other; entries of the diagonal are halved
};

}  // namespace vehd
