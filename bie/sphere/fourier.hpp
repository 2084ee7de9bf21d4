#pragma once

#include <array>
#include <optional>
#include <vector>

#include "bie/sphere/fast_fourier.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Fourier sums over equispaced longitudes φ_k = 2πk/n_phi, of many rows at once:
///   f(φ) = Σ_m (C_m cos mφ + S_m sin mφ),  m = 0 … order,
/// as products of small matrices over a quarter of the circle, since longitudes φ, π − φ, π + φ and −φ differ in signs
/// alone, or of high orders by FastFourier, whichever takes less (docs/performance.md).
/// Accuracy: rounding; round trips of the transform to 2e-13 (tests/sphere/transform_test.cpp)
class FourierSums {
 public:
  /// @param n_phi  even, at least 2 order + 2
  FourierSums(int n_phi, int order);

  /// C_0 … C_order, then S_1 … S_order.
  [[nodiscard]] Index n_modes() const { return 2 * order_ + 1; }
  [[nodiscard]] Index cosine_mode(int m) const { return m; }
  [[nodiscard]] Index sine_mode(int m) const { return order_ + m; }

  /// @param amplitudes  that of a mode in a row at [mode * stride + row]
  /// @param values      [rows x n_phi], φ fastest
  void synthesize(Index rows, const double* amplitudes, Index stride, double* values) const;
  /// The other way: exact for waves up to the order.
  /// @param amplitudes  [rows x n_modes], modes fastest
  void analyze(Index rows, const double* values, double* amplitudes) const;

 private:
  /// Cosines of even, of odd, sines of even, of odd orders.
  static constexpr int kFamilies = 4;
  struct Family {
    Index first_mode = 0, n_modes = 0;  ///< every other mode
    RowMatrix synthesis;                ///< [modes x quarter], filled up with zeros
    RowMatrix analysis;                 ///< [quarter x modes], likewise
  };

  void unfold(const std::array<const double*, kFamilies>& parts, double* values) const;
  void fold(const double* values, const std::array<double*, kFamilies>& parts) const;

  int n_phi_;
  int order_;
  Index n_quarter_;  ///< longitudes from 0 to π/2
  std::array<Family, kFamilies> families_;
  std::optional<FastFourier> fast_;  ///< of high orders, in the place of the families
};

}  // namespace vehd
