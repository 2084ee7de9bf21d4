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

  /// Amplitudes of cos mφ for m = 0..order, then of sin mφ for m = 1..order.
  [[nodiscard]] Index n_modes() const { return 2 * order_ + 1; }
  /// Columns that are summed together, so that what is summed over them stays in cache.
  static constexpr Index kPiece = 24 * kLanes;
  /// Which of several latitudes the rows belong to.
  struct Latitude {
    Index index = 0, count = 1;
  };
  /// @param rows   [n_phi x width], one behind the other
  /// @param width  a multiple of kLanes
  /// @param modes  where the amplitudes of each mode go, [pieces][latitudes][kPiece]; the last piece has what is left
  void run(const double* rows, Index width, const std::vector<double*>& modes, const Latitude& latitude) const;

 private:
  /// Modes that share the sums over a quarter of the circle.
  struct Family {
    std::vector<Index> modes;
    RowMatrix table;  ///< [modes x quarter]
  };

  int n_phi_;
  int order_;
  Index n_quarter_;               ///< longitudes from 0 to π/2
  std::vector<Family> families_;  ///< cosines of even, of odd, sines of even, of odd m
};

}  // namespace vehd
