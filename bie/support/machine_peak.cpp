#include "bie/support/machine_peak.hpp"

#include <algorithm>
#include <chrono>

#include "bie/support/types.hpp"

namespace vehd {

double measured_peak(int n_threads) {
  constexpr Index kSize = 256;
  constexpr int kProducts = 8, kWindows = 32;
  constexpr double kSeconds = 0.25;
  const double operations = 2.0 * kProducts * kSize * kSize * kSize * n_threads;
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto begin = now();
  double best = 0.0;
  for (int window = 0; window < kWindows && std::chrono::duration<double>(now() - begin).count() < kSeconds; ++window) {
    const auto start = now();
#pragma omp parallel for num_threads(n_threads) schedule(static)
    for (int thread = 0; thread < n_threads; ++thread) {
      const Matrix a = Matrix::Constant(kSize, kSize, 0.5);
      Matrix b = a;
      Matrix c(kSize, kSize);
      for (int i = 0; i < kProducts; ++i) {
        c.noalias() = a * b;
        b(0, 0) = 1.0 / c(0, 0);
      }
    }
    best = std::max(best, operations / std::chrono::duration<double>(now() - start).count());
  }
  return best;
}

}  // namespace vehd
