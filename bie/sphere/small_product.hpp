#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Targets that stand side by side at least; columns of small_product are a multiple of it. An instruction handles as
/// many doubles, or twice as many where the processor has such.
constexpr int kLanes = 4;

/// The least multiple of it that is not below a count.
constexpr Index filled_up(Index count) { return (count + kLanes - 1) / kLanes * kLanes; }

/// The least multiple of what a register of this processor holds that is not below a count: of so many columns none is
/// left to narrower registers.
Index whole_registers(Index count);

/// A factor whose entry (i, k) is at data[i * row_stride + k * column_stride]: a table, a part of it, or its transpose.
struct Factor {
  const double* data;
  Index row_stride, column_stride;
};

/// C = A B where B and C have contiguous rows and A is small. Nothing is copied: libraries rearrange both factors
/// before they multiply, which for A of ten to forty rows takes as long as the product itself.
/// @param inner     columns of A and rows of B; 0 makes C zero
/// @param columns   of B and C, a multiple of kLanes
/// @param b_stride  from a row of B to the next, c_stride likewise
/// Accuracy: rounding; terms are added in the order of k (tests/sphere/small_product_test.cpp)
void small_product(Index rows, Index inner, Index columns, const Factor& a, const double* b, Index b_stride, double* c,
                   Index c_stride);

}  // namespace vehd
