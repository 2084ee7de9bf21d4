#pragma once

#include <cstdint>
#include <random>

namespace vehd {

/// Normally distributed numbers. A seed gives the same ones with every standard library: the generator is that of the
/// standard, the rest is written here.
/// Source: Box and Muller 1958
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : generator_(seed) {}

  /// Of mean 0 and variance 1.
  double operator()();

 private:
  std::mt19937_64 generator_;
};

}  // namespace vehd
