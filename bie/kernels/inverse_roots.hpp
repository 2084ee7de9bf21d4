#pragma once

#ifdef __AVX512VL__
#include <immintrin.h>
#endif

#include <array>
#include <cmath>
#include <cstddef>

namespace vehd {

/// Replaces each number s by 1/√s. With AVX-512, two Newton steps y ← y + y (½ − ½ s y²) refine the processor's
/// estimate from 14 to 53 bits, in a third of the time of a square root and a division.
/// @param squares  > 0; two, four or eight numbers, which one instruction handles together
/// Accuracy: two units in the last place (tests/potentials/inverse_roots_test.cpp)
template <std::size_t kCount>
void invert_roots(std::array<double, kCount>& squares) {
  static_assert(kCount == 2 || kCount == 4 || kCount == 8);
#ifdef __AVX512VL__
  if constexpr (kCount == 8) {
    const __m512d half = _mm512_set1_pd(0.5), s = _mm512_mul_pd(half, _mm512_loadu_pd(squares.data()));
    __m512d y = _mm512_rsqrt14_pd(_mm512_add_pd(s, s));
    for (int step = 0; step < 2; ++step) {
      y = _mm512_fmadd_pd(y, _mm512_fnmadd_pd(_mm512_mul_pd(s, y), y, half), y);
    }
    _mm512_storeu_pd(squares.data(), y);
  } else if constexpr (kCount == 4) {
    const __m256d half = _mm256_set1_pd(0.5), s = _mm256_mul_pd(half, _mm256_loadu_pd(squares.data()));
    __m256d y = _mm256_rsqrt14_pd(_mm256_add_pd(s, s));
    for (int step = 0; step < 2; ++step) {
      y = _mm256_fmadd_pd(y, _mm256_fnmadd_pd(_mm256_mul_pd(s, y), y, half), y);
    }
    _mm256_storeu_pd(squares.data(), y);
  } else
#endif
  {
#pragma omp simd
    for (std::size_t i = 0; i < kCount; ++i) squares[i] = 1.0 / std::sqrt(squares[i]);
  }
}

}  // namespace vehd
