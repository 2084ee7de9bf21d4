#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Smallest number of targets processed side by side; the columns of small_product are a multiple of it. One
/// instruction handles this many doubles, or twice as many if the processor supports that.
constexpr int kLanes = 4;

/// Smallest multiple of kLanes that is not below a count.
constexpr Index filled_up(Index count) { return (count + kLanes - 1) / kLanes * kLanes; }

/// Smallest multiple of kLanes and of the register width of this processor that is not below a count: that many columns
/// leave no remainder for narrower registers.
Index whole_registers(Index count);

/// Factor with entry (i, k) at data[i * row_stride + k * column_stride]: a table, part of a table, or its transpose.
struct Factor {
  const double* data;
  Index row_stride, column_stride;
};

/// C = A B for small A; B and C have contiguous rows. Nothing is copied: libraries rearrange both factors before
/// multiplying, which for ten to forty rows of A takes as long as the product itself.
/// @param inner     columns of A and rows of B; 0 makes C zero
/// @param columns   of B and C, a multiple of kLanes
/// @param b_stride  distance between rows of B; c_stride of C
/// Accuracy: rounding; terms are added in the order of k (tests/sphere/small_product_test.cpp)
void small_product(Index rows, Index inner, Index columns, const Factor& a, const double* b, Index b_stride, double* c,
                   Index c_stride);

}  // namespace vehd
