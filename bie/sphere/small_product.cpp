#include "bie/sphere/small_product.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace vehd {

namespace {

#ifdef __AVX512F__
/// Doubles per register. Rows of C, and registers per row, that stay in registers: 24 sums, three pieces of B and one
/// entry of A use 28 of 32.
constexpr int kWide = 2 * kLanes;
constexpr int kMostRows = 8;
#else
/// Doubles per register. Rows of C, and registers per row, that stay in registers: twelve sums, three pieces of B and
/// one entry of A use all sixteen.
#ifdef __AVX__
constexpr int kWide = kLanes;
#else
constexpr int kWide = kLanes / 2;
#endif
constexpr int kMostRows = 4;
#endif
constexpr int kMostPieces = 3;

template <int kWidth>
struct Register {
  using Values [[gnu::vector_size(kWidth * sizeof(double))]] = double;
  /// Values at any address of a double.
  using Anywhere [[gnu::vector_size(kWidth * sizeof(double)), gnu::aligned(alignof(double)), gnu::may_alias]] = double;
};

template <int kWidth, int kRows, int kPieces>
void block(const double* entry, Index row_stride, Index column_stride, Index inner, const double* b, Index b_stride,
           double* c, Index c_stride) {
  using Values = typename Register<kWidth>::Values;
  using Anywhere = typename Register<kWidth>::Anywhere;
  Values sum[kRows][kPieces] = {};
  for (Index k = 0; k < inner; ++k, entry += column_stride, b += b_stride) {
    Values piece[kPieces];
#pragma GCC unroll 3
    for (int i = 0; i < kPieces; ++i) piece[i] = *reinterpret_cast<const Anywhere*>(b + i * kWidth);
#pragma GCC unroll 8
    for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 3
      for (int i = 0; i < kPieces; ++i) sum[r][i] += entry[r * row_stride] * piece[i];
    }
  }
#pragma GCC unroll 8
  for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 3
    for (int i = 0; i < kPieces; ++i) *reinterpret_cast<Anywhere*>(c + r * c_stride + i * kWidth) = sum[r][i];
  }
}

/// Size of the next block: kMost while enough are left, then the larger half of the rest, so that no block has only
/// one. Without a division, which takes as long as a small block.
template <int kMost>
Index next_share(Index left) {
  return left >= 2 * kMost ? kMost : left > kMost ? (left + 1) / 2 : left;
}

/// All rows of a few columns.
template <int kWidth, int kPieces>
void panel(Index rows, Index inner, const Factor& a, const double* b, Index b_stride, double* c, Index c_stride) {
  static constexpr auto blocks = []<int... kHeights>(std::integer_sequence<int, kHeights...>) {
    return std::array{&block<kWidth, kHeights + 1, kPieces>...};
  }
  (std::make_integer_sequence<int, kMostRows>());
  const double* entry = a.data;
  for (Index left = rows; left > 0;) {
    const Index height = next_share<kMostRows>(left);
    blocks[static_cast<std::size_t>(height - 1)](entry, a.row_stride, a.column_stride, inner, b, b_stride, c, c_stride);
    left -= height;
    entry += height * a.row_stride;
    c += height * c_stride;
  }
}

}  // namespace

Index whole_registers(Index count) {
  constexpr Index kWhole = std::max(kWide, kLanes);
  return (count + kWhole - 1) / kWhole * kWhole;
}

void small_product(Index rows, Index inner, Index columns, const Factor& a, const double* b, Index b_stride, double* c,
                   Index c_stride) {
  // A matrix without rows is a null pointer, which has no offsets.
  if (rows == 0) return;
  const Index pieces = columns / kWide;
  for (Index done = 0; done < pieces;) {
    const Index width = next_share<kMostPieces>(pieces - done);
    const double* from = b + done * kWide;
    double* to = c + done * kWide;
    switch (width) {
      case 3:
        panel<kWide, 3>(rows, inner, a, from, b_stride, to, c_stride);
        break;
      case 2:
        panel<kWide, 2>(rows, inner, a, from, b_stride, to, c_stride);
        break;
      default:
        panel<kWide, 1>(rows, inner, a, from, b_stride, to, c_stride);
    }
    done += width;
  }
  if (const Index done = pieces * kWide; done < columns) {
    panel<kLanes, 1>(rows, inner, a, b + done, b_stride, c + done, c_stride);
  }
}

}  // namespace vehd
