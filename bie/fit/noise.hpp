#pragma once

#include <cstdint>
#include <random>

namespace vehd {

/// Normally distributed numbers. The same seed gives the same numbers with every standard library: the generator is
/// that of the standard, the rest is written here. Source: G. E. P. Box, M. E. Muller, Ann. Math. Stat. 29 (1958) 610
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : generator_(seed) {}

  /// Of mean 0 and variance 1.
  double operator()();

 private:
  std::mt19937_64 generator_;
};

}  // namespace vehd
