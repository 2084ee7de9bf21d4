#pragma once

#include <array>
#include <optional>

#include "bie/sphere/fast_fourier.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Amplitudes of one function on the latitudes of a hemisphere, the equator among them: of its part that is symmetric
/// about the equator, and behind that of the antisymmetric one. Those of order m on the i-th latitude are at
/// [m * stride + i]; all are finite, sines of m = 0 count for nothing.
struct HemisphereAmplitudes {
  std::array<const double*, 2> cosines, sines;
  Index stride;
  bool minus_sines = false;  ///< sines count negative
};

/// Layout of the amplitudes that analysis finds: a block for each part, for even and odd m, and for cosines and sines,
/// numbered in this order with the last one fastest. Block b is at data + b * block: [latitudes x row_length] with
/// order m in column m/2.
struct FoundAmplitudes {
  static constexpr int kBlocks = 8;
  double* data;
  Index block;

  static constexpr int number(int part, int m, bool sine) { return (part * 2 + m % 2) * 2 + (sine ? 1 : 0); }
};

/// Fourier sums over equispaced longitudes φ_k = 2πk/n_phi, on all latitudes of a grid that is its own mirror image:
///   f(φ) = Σ_m (C_m cos mφ + S_m sin mφ),  m = 0 … order,
/// as products of small matrices over a quarter of the circle and a hemisphere, since longitudes φ, π − φ, π + φ and −φ
/// and latitudes θ and π − θ differ in signs alone, or of high orders by FastFourier, whichever takes less
/// (docs/performance.md).
/// Accuracy: rounding; round trips of the transform to 2e-13 (tests/sphere/transform_test.cpp)
class FourierSums {
 public:
  /// @param n_phi  even, at least 2 order + 2
  /// @throws ShapeError if n_phi is odd
  FourierSums(int n_phi, int order);

  /// Row length of FoundAmplitudes.
  [[nodiscard]] Index row_length() const { return row_length_; }

  /// @param values  [n_theta x n_phi], φ fastest
  void synthesize(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const;
  /// Northern latitudes plus, for the antisymmetric part minus, their mirror images; the equator, which is its own one,
  /// counts once. Exact for waves up to the order.
  void analyze(Index n_theta, const double* values, const FoundAmplitudes& amplitudes) const;

 private:
  /// Cosines, sines and minus sines of even and of odd orders.
  static constexpr int kWaves = 3;

  /// As many longitudes at a time.
  template <int kWidth>
  void synthesize_by_products(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const;
  /// So many latitudes from the first one on with their images.
  template <int kRows, int kWidth>
  void synthesize_rows(Index first, Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const;
  void synthesize_quarter_turns(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const;
  void synthesize_fast(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const;
  void analyze_quarter_turns(Index n_theta, const double* values, const FoundAmplitudes& amplitudes) const;
  void analyze_fast(Index n_theta, const double* values, const FoundAmplitudes& amplitudes) const;

  int n_phi_;
  int order_;
  Index n_quarter_;  ///< longitudes from 0 to π/2
  Index row_length_;
  RowMatrix synthesis_;                               ///< [orders x kWaves quarters, each filled up with zeros]
  std::array<std::array<RowMatrix, 2>, 2> analysis_;  ///< of m even and odd, of cosines and sines: [quarter x orders]
  std::optional<FastFourier> fast_;                   ///< of high orders, in the place of the tables
};

}  // namespace vehd
