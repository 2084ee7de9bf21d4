#pragma once

#include <algorithm>
#include <array>
#include <memory>

#include "bie/support/types.hpp"

namespace vehd {

/// Harmonic coefficients of many columns in the rectangular layout [m][n][column], cosines and sines apart: rows of
/// one m are contiguous (Legendre sums), rows of one n have a constant stride (Wigner blocks). Sines of order 0 are
/// zero; all else is for who fills it, since clearing as much took longer than many a sum.
class CoefficientBlock {
 public:
  /// @param highest  m
  CoefficientBlock(int order, int highest, Index cosine_columns, Index sine_columns)
      : width_(order + 1),
        columns_{cosine_columns, sine_columns},
        values_{std::make_unique_for_overwrite<double[]>((highest + 1) * width_ * cosine_columns),
                std::make_unique_for_overwrite<double[]>((highest + 1) * width_ * sine_columns)} {
    std::fill_n(values_[1].get(), order_stride(true), 0.0);
  }

  [[nodiscard]] Index columns(bool sine) const { return columns_[sine]; }
  /// From a degree of one order to the next.
  [[nodiscard]] Index degree_stride(bool sine) const { return columns_[sine]; }
  /// From an order of one degree to the next.
  [[nodiscard]] Index order_stride(bool sine) const { return width_ * columns_[sine]; }
  double* row(bool sine, int n, int m) { return values_[sine].get() + (m * width_ + n) * columns_[sine]; }
  const double* row(bool sine, int n, int m) const { return values_[sine].get() + (m * width_ + n) * columns_[sine]; }

 private:
  Index width_;
  std::array<Index, 2> columns_;
  std::array<std::unique_ptr<double[]>, 2> values_;
};

/// Fourier amplitudes along every latitude of the rotated grid, cosines and sines apart: of each latitude the even
/// orders, then the odd ones. Order 0 begins with zeros; all else is for who fills it.
class AzimuthalAmplitudes {
 public:
  AzimuthalAmplitudes(int n_theta, int order, Index cosine_columns, Index sine_columns)
      : n_orders_(order + 1),
        n_even_(order / 2 + 1),
        columns_{cosine_columns, sine_columns},
        values_{std::make_unique_for_overwrite<double[]>(n_theta * n_orders_ * cosine_columns),
                std::make_unique_for_overwrite<double[]>(n_theta * n_orders_ * sine_columns)} {
    for (const bool sine : {false, true}) {
      for (int i = 0; i < n_theta; ++i) std::fill_n(of_order(sine, i, 0), columns_[sine], 0.0);
    }
  }

  [[nodiscard]] Index columns(bool sine) const { return columns_[sine]; }
  double* of_order(bool sine, int i, int m) {
    return values_[sine].get() + (i * n_orders_ + m / 2 + (m % 2 == 0 ? 0 : n_even_)) * columns_[sine];
  }

 private:
  Index n_orders_, n_even_;
  std::array<Index, 2> columns_;
  std::array<std::unique_ptr<double[]>, 2> values_;
};

}  // namespace vehd
