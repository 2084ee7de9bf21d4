#pragma once

#include <cstdint>
#include <random>

namespace vehd {

/// Normally distributed numbers. A seed gives the same numbers with every standard library: the standard specifies the
/// generator but not its normal distribution, which is computed here.
/// Source: Box and Muller 1958
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : generator_(seed) {}

  /// Next number, of mean 0 and variance 1.
  double operator()();

 private:
  std::mt19937_64 generator_;
};

}  // namespace vehd
