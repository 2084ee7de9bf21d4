#pragma once

#include <cstring>

#ifndef __AVX__
// Vectors of four numbers are passed between functions of one file alone, whatever others agree on.
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace vehd {

/// So many numbers side by side, a register of the compiler's own kind or some of them: what arrays and classes hold
/// goes through memory between one loop and the next.
template <int kWidth>
struct Lanes {
  using Values [[gnu::vector_size(kWidth * sizeof(double))]] = double;

  /// The values that stand from there on.
  static Values load(const double* at) {
    Values values;
    std::memcpy(&values, at, sizeof values);
    return values;
  }
  static void store(double* at, const Values& values) { std::memcpy(at, &values, sizeof values); }
};

}  // namespace vehd
