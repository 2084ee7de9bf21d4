#pragma once

#include <array>

#include "bie/sphere/small_product.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Fourier sums over the azimuths ψ_k = (k + ½) 2π/n of a graded rule, and their adjoint, of many columns at once:
/// matrix products over a quarter of the circle, because ψ, π − ψ, π + ψ and −ψ differ in signs alone. Accuracy:
/// rounding (tests/potentials/azimuth_sums_test.cpp)
class AzimuthSums {
 public:
  AzimuthSums() = default;
  /// @param n_phi  azimuths, a multiple of 4
  /// @param order  highest m
  /// @throws ShapeError if n_phi is none
  AzimuthSums(int n_phi, int order);

  /// Amplitudes of cos mψ for m = 0..order, then of sin mψ for m = 1..order.
  [[nodiscard]] Index n_modes() const { return 2 * order_ + 1; }
  /// Values at the azimuths. @param amplitudes  [n_modes x width], the width a multiple of kLanes
  [[nodiscard]] RowMatrix values(const RowMatrix& amplitudes) const;
  /// Σ_k of values times cos mψ_k or sin mψ_k. @param values  [n_phi x width], the width a multiple of kLanes
  /// @return  [n_modes x width]
  [[nodiscard]] RowMatrix adjoint(const RowMatrix& values) const;

 private:
  /// Modes that are even or odd under ψ → −ψ and under ψ → π − ψ.
  struct Family {
    Index first = 0, count = 0;  ///< every second mode from the first one
    RowMatrix table;             ///< [quarter x modes]
  };

  int n_phi_ = 0;
  int order_ = 0;
  std::array<Family, 4> families_;  ///< cosines of even, of odd, sines of even, of odd m
};

}  // namespace vehd
