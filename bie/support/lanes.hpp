#pragma once

#include <cstring>

#ifndef __AVX__
// Vectors of four numbers are passed only within one file, so calling conventions of other files do not matter.
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace vehd {

/// kWidth numbers side by side in the vector type of the compiler, one register or several. Arrays and classes would go
/// through memory between one loop and the next.
template <int kWidth>
struct Lanes {
  using Values [[gnu::vector_size(kWidth * sizeof(double))]] = double;

  /// The kWidth values from this address on.
  static Values load(const double* at) {
    Values values;
    std::memcpy(&values, at, sizeof values);
    return values;
  }
  static void store(double* at, const Values& values) { std::memcpy(at, &values, sizeof values); }
};

}  // namespace vehd
