#pragma once

#include <vector>

#include "bie/sphere/grid.hpp"
#include "bie/sphere/small_product.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Fourier amplitudes over the equispaced longitudes of a grid, of many columns at once: the sums are matrix products
/// over a quarter of the circle, because terms at ±φ and π ± φ differ only in sign. Products of this size are faster
/// than transforms whose length has large prime factors, as p + 1 may have.
/// Accuracy: rounding (tests/potentials/longitude_sums_test.cpp)
class LongitudeSums {
 public:
  /// @param grid   with an even number of longitudes
  /// @param order  highest m
  LongitudeSums(const SphereGrid& grid, int order);

  /// m of each mode: cosines of even m, of odd m, then sines with −m in place of m.
  [[nodiscard]] const std::vector<int>& orders() const { return orders_; }
  /// Columns that are summed together, so that their sums stay in cache.
  static constexpr Index kPiece = 24 * kLanes;
  /// Index of the latitude of the rows among several.
  struct Latitude {
    Index index = 0, count = 1;
  };
  /// @param rows        [n_phi x width], one after another
  /// @param width       a multiple of kLanes
  /// @param amplitudes  result for that latitude in [pieces][latitudes][modes][kPiece]; the last piece may be narrower
  void run(const double* rows, Index width, const Latitude& latitude, double* amplitudes) const;

 private:
  int n_phi_;
  std::vector<int> orders_;
  Index n_quarter_;  ///< longitudes from 0 to π/2
  /// Per family of modes that share the sums over a quarter of the circle, [modes x quarter].
  std::vector<RowMatrix> tables_;
};

}  // namespace vehd
