#pragma once

#include <array>
#include <bit>

#include "bie/kernels/inverse_roots.hpp"
#include "bie/support/lanes.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Number of nodes that one instruction handles: the doubles of a register.
#if defined(__AVX512F__)
constexpr Index kTogether = 8;
#elif defined(__AVX__)
constexpr Index kTogether = 4;
#else
constexpr Index kTogether = 2;
#endif
/// One register of values.
using Few = Lanes<kTogether>::Values;

/// Loads kTogether values from an address on.
inline Few few(const double* at) { return Lanes<kTogether>::load(at); }

inline void store(double* at, const Few& values) { Lanes<kTogether>::store(at, values); }

/// 1/√s of each.
inline Few inverse_root(const Few& squares) {
  auto roots = std::bit_cast<std::array<double, kTogether>>(squares);
  invert_roots(roots);
  return std::bit_cast<Few>(roots);
}

/// Sum of the values from index `from` on.
inline double sum(const Few& values, Index from = 0) {
  double result = 0.0;
  for (Index i = from; i < kTogether; ++i) result += values[i];
  return result;
}

}  // namespace vehd
