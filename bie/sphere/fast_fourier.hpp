#pragma once

#include <fftw3.h>

#include <memory>
#include <type_traits>

#include "bie/support/types.hpp"

namespace vehd {

/// Fourier sums over the longitudes of one circle in O(n log n), see FourierSums; for long circles.
/// Plans are made with FFTW_ESTIMATE: measured plans, and with them the last bits of the results, differ from run to
/// run. Copies share their plans; calls are thread safe.
/// Accuracy: rounding; agrees with products of matrices (tests/sphere/fourier_test.cpp)
/// Source: FFTW (Frigo and Johnson 2005)
class FastFourier {
 public:
  /// @param n_phi  even, at least 2 order + 2
  FastFourier(int n_phi, int order);

  /// @param amplitudes  C_0 … C_order, S_1 … S_order of a row at [mode * stride + row]
  /// @param values      [rows x n_phi], φ fastest
  void synthesize(Index rows, const double* amplitudes, Index stride, double* values) const;
  /// @param amplitudes  [rows x (2 order + 1)], modes fastest
  void analyze(Index rows, const double* values, double* amplitudes) const;

 private:
  using Plan = std::shared_ptr<std::remove_pointer_t<fftw_plan>>;

  int n_phi_;
  int order_;
  Plan backward_;
  Plan forward_;
};

}  // namespace vehd
