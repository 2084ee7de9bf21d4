#pragma once

#include <algorithm>
#include <array>

#include "bie/support/types.hpp"

namespace vehd {

/// Harmonic coefficients of many columns in the rectangular layout [m][n][column], cosines and sines apart: rows of
/// one m are contiguous (Legendre sums), rows of one n have a constant stride (Wigner blocks).
class CoefficientBlock {
 public:
  /// @param highest  m
  CoefficientBlock(int order, int highest, Index cosine_columns, Index sine_columns)
      : width_(order + 1),
        columns_{cosine_columns, sine_columns},
        values_{Vector::Zero((highest + 1) * width_ * cosine_columns),
                Vector::Zero((highest + 1) * width_ * sine_columns)} {}

  [[nodiscard]] Index columns(bool sine) const { return columns_[sine]; }
  /// From a degree of one order to the next.
  [[nodiscard]] Index degree_stride(bool sine) const { return columns_[sine]; }
  /// From an order of one degree to the next.
  [[nodiscard]] Index order_stride(bool sine) const { return width_ * columns_[sine]; }
  double* row(bool sine, int n, int m) { return values_[sine].data() + (m * width_ + n) * columns_[sine]; }
  const double* row(bool sine, int n, int m) const { return values_[sine].data() + (m * width_ + n) * columns_[sine]; }

 private:
  Index width_;
  std::array<Index, 2> columns_;
  std::array<Vector, 2> values_;  ///< matrices begin where registers do, other arrays do not
};

/// Fourier amplitudes along latitudes of the rotated grid, cosines and sines apart: of each latitude the even orders,
/// then the odd ones.
class AzimuthalAmplitudes {
 public:
  AzimuthalAmplitudes(int n_latitudes, int order, Index cosine_columns, Index sine_columns)
      : n_orders_(order + 1),
        n_even_(order / 2 + 1),
        columns_{cosine_columns, sine_columns},
        values_{Vector::Zero(n_latitudes * n_orders_ * cosine_columns),
                Vector::Zero(n_latitudes * n_orders_ * sine_columns)} {}

  [[nodiscard]] Index columns(bool sine) const { return columns_[sine]; }
  /// From an order on one latitude to the same on the next.
  [[nodiscard]] Index latitude_stride(bool sine) const { return n_orders_ * columns_[sine]; }
  double* of_order(bool sine, int i, int m) {
    return values_[sine].data() + (i * n_orders_ + m / 2 + (m % 2 == 0 ? 0 : n_even_)) * columns_[sine];
  }
  /// Adds all of one latitude to those of another.
  void add_latitude(int from, int to) {
    for (const bool sine : {false, true}) {
      const Index count = latitude_stride(sine);
      for (Index i = 0; i < count; ++i) values_[sine][to * count + i] += values_[sine][from * count + i];
    }
  }
  void copy_latitude(int from, int to) {
    for (const bool sine : {false, true}) {
      const Index count = latitude_stride(sine);
      std::copy_n(values_[sine].data() + from * count, count, values_[sine].data() + to * count);
    }
  }

 private:
  Index n_orders_, n_even_;
  std::array<Index, 2> columns_;
  std::array<Vector, 2> values_;  ///< matrices begin where registers do, other arrays do not
};

}  // namespace vehd
