#pragma once

#include <array>
#include <optional>

#include "bie/sphere/fast_fourier.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Fourier amplitudes of one function on the latitudes of a hemisphere, equator included: first of its part that is
/// symmetric about the equator, then of the antisymmetric part. Order m on the i-th latitude is at [m * stride + i].
/// All entries must be finite; sines of m = 0 do not contribute.
struct HemisphereAmplitudes {
  std::array<const double*, 2> cosines, sines;
  Index stride;
  bool minus_sines = false;  ///< sines enter with the opposite sign
};

/// Layout of the amplitudes that analysis computes: one block for each part, parity of m, and cosine or sine, numbered
/// in this order with the last index fastest. Block b is at data + b * block: [latitudes x row_length] with order m in
/// column m/2.
struct AnalysedAmplitudes {
  static constexpr int kBlocks = 8;
  double* data;
  Index block;

  static constexpr int number(int part, int m, bool sine) { return (part * 2 + m % 2) * 2 + (sine ? 1 : 0); }
};

/// Fourier sums over equispaced longitudes φ_k = 2πk/n_phi, on all latitudes of a grid symmetric about the equator:
///   f(φ) = Σ_m (C_m cos mφ + S_m sin mφ),  m = 0 … order,
/// as products of small matrices over a quarter of the circle and a hemisphere, since terms at longitudes ±φ and π ± φ
/// and at latitudes θ and π − θ differ only in sign; for high orders by FastFourier where that is faster:
/// on processors without AVX.
/// Accuracy: rounding; round trips of the transform to 2e-13 (tests/sphere/transform_test.cpp)
class FourierSums {
 public:
  /// @param n_phi  even, at least 2 order + 2
  /// @throws ShapeError if n_phi is odd
  FourierSums(int n_phi, int order);

  /// Row length of AnalysedAmplitudes.
  [[nodiscard]] Index row_length() const { return row_length_; }

  /// @param values  [n_theta x n_phi], φ fastest
  void synthesize(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const;
  /// Amplitudes of northern latitudes plus (antisymmetric part: minus) their mirror images; the equator counts once.
  /// Exact for Fourier modes up to the order.
  void analyze(Index n_theta, const double* values, const AnalysedAmplitudes& amplitudes) const;

 private:
  /// Cosines, sines and minus sines of even and of odd orders.
  static constexpr int kWaves = 3;

  /// Processes kWidth longitudes at a time.
  template <int kWidth>
  void synthesize_by_products(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const;
  /// Processes kRows latitudes from `first` on with their mirror images.
  template <int kRows, int kWidth>
  void synthesize_rows(Index first, Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const;
  void synthesize_quarter_turns(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const;
  void synthesize_fast(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const;
  void analyze_quarter_turns(Index n_theta, const double* values, const AnalysedAmplitudes& amplitudes) const;
  void analyze_fast(Index n_theta, const double* values, const AnalysedAmplitudes& amplitudes) const;

  int n_phi_;
  int order_;
  Index n_quarter_;  ///< longitudes from 0 to π/2
  Index row_length_;
  RowMatrix synthesis_;                               ///< [orders x kWaves quarters, each filled up with zeros]
  std::array<std::array<RowMatrix, 2>, 2> analysis_;  ///< of m even and odd, of cosines and sines: [quarter x orders]
  std::optional<FastFourier> fast_;                   ///< for high orders, instead of the tables
};

}  // namespace vehd
