#pragma once

#include <vector>

#include "bie/sphere/grid.hpp"
#include "bie/sphere/small_product.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Fourier amplitudes over the equispaced longitudes of a grid, of many columns at once: the sums are matrix products
/// over a quarter of the circle, because longitudes φ, π − φ, π + φ and −φ differ in signs alone. Products of that size
/// beat transforms of a length with large factors, as p + 1 has them.
/// Accuracy: rounding (tests/potentials/longitude_sums_test.cpp)
class LongitudeSums {
 public:
  /// @param grid   its number of longitudes is even
  /// @param order  highest m
  LongitudeSums(const SphereGrid& grid, int order);

  /// m of each mode: even cosines, odd cosines, then sines, whose m is negative.
  [[nodiscard]] const std::vector<int>& orders() const { return orders_; }
  /// Columns that are summed together, so that their sums stay in cache.
  static constexpr Index kPiece = 24 * kLanes;
  /// Which of several latitudes the rows belong to.
  struct Latitude {
    Index index = 0, count = 1;
  };
  /// @param rows        [n_phi x width], one behind the other
  /// @param width       a multiple of kLanes
  /// @param amplitudes  of that latitude in [pieces][latitudes][modes][kPiece]; the last piece has the rest
  void run(const double* rows, Index width, const Latitude& latitude, double* amplitudes) const;

 private:
  int n_phi_;
  std::vector<int> orders_;
  Index n_quarter_;  ///< longitudes from 0 to π/2
  /// Of modes that share the sums over a quarter of the circle, [modes x quarter].
  std::vector<RowMatrix> tables_;
};

}  // namespace vehd
