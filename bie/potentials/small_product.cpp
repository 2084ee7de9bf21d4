#include "bie/potentials/small_product.hpp"

#include <algorithm>

namespace vehd {

namespace {

using Lanes [[gnu::vector_size(kLanes * sizeof(double))]] = double;
/// The same at any address of a double.
using LanesAnywhere [[gnu::vector_size(kLanes * sizeof(double)), gnu::aligned(alignof(double)), gnu::may_alias]] =
    double;

/// Rows and lanes of C that stay in registers: twelve sums, three pieces of B and one entry of A fill sixteen.
constexpr int kMostRows = 4;
constexpr int kMostPieces = 3;

template <int kRows, int kPieces>
void block(Index inner, const Factor& a, const double* b, Index b_stride, double* c, Index c_stride) {
  Lanes sum[kRows][kPieces] = {};
  const double* entry = a.data;
  const Index row_stride = a.row_stride;
  for (Index k = 0; k < inner; ++k, entry += a.column_stride, b += b_stride) {
    Lanes piece[kPieces];
#pragma GCC unroll 3
    for (int i = 0; i < kPieces; ++i) piece[i] = *reinterpret_cast<const LanesAnywhere*>(b + i * kLanes);
#pragma GCC unroll 4
    for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 3
      for (int i = 0; i < kPieces; ++i) sum[r][i] += entry[r * row_stride] * piece[i];
    }
  }
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 3
    for (int i = 0; i < kPieces; ++i) *reinterpret_cast<LanesAnywhere*>(c + r * c_stride + i * kLanes) = sum[r][i];
  }
}

/// All rows of a few columns, in blocks of nearly equal height.
template <int kPieces>
void panel(Index rows, Index inner, Factor a, const double* b, Index b_stride, double* c, Index c_stride) {
  const Index n_blocks = (rows + kMostRows - 1) / kMostRows;
  for (Index i = 0, done = 0; i < n_blocks; ++i) {
    const Index height = rows * (i + 1) / n_blocks - done;
    switch (height) {
      case 4:
        block<4, kPieces>(inner, a, b, b_stride, c, c_stride);
        break;
      case 3:
        block<3, kPieces>(inner, a, b, b_stride, c, c_stride);
        break;
      case 2:
        block<2, kPieces>(inner, a, b, b_stride, c, c_stride);
        break;
      default:
        block<1, kPieces>(inner, a, b, b_stride, c, c_stride);
    }
    done += height;
    a.data += height * a.row_stride;
    c += height * c_stride;
  }
}

}  // namespace

void small_product(Index rows, Index inner, Index columns, const Factor& a, const double* b, Index b_stride, double* c,
                   Index c_stride) {
  const Index pieces = columns / kLanes;
  const Index n_panels = (pieces + kMostPieces - 1) / kMostPieces;
  for (Index i = 0, done = 0; i < n_panels; ++i) {
    const Index width = pieces * (i + 1) / n_panels - done;
    const double* from = b + done * kLanes;
    double* to = c + done * kLanes;
    switch (width) {
      case 3:
        panel<3>(rows, inner, a, from, b_stride, to, c_stride);
        break;
      case 2:
        panel<2>(rows, inner, a, from, b_stride, to, c_stride);
        break;
      default:
        panel<1>(rows, inner, a, from, b_stride, to, c_stride);
    }
    done += width;
  }
}

}  // namespace vehd
