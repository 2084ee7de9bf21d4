#include "bie/potentials/longitude_sums.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Prefetches `count` numbers from an address on, none if the count is not positive.
void prefetch_to_write(const double* from, Index count) {
  constexpr Index kCacheLine = 8;
  for (Index i = 0; i < count; i += kCacheLine) __builtin_prefetch(from + i, 1);
}

}  // namespace

LongitudeSums::LongitudeSums(const SphereGrid& grid, int order) : n_phi_(grid.n_phi), n_quarter_(grid.n_phi / 4 + 1) {
  require_size("longitudes (even)", grid.n_phi % 2, 0);
  for (const bool sine : {false, true}) {
    for (const int parity : {0, 1}) {
      const int lowest = sine && parity == 0 ? 2 : parity;  // sin 0φ vanishes
      RowMatrix table((order - lowest + 2) / 2, n_quarter_);
      for (Index i = 0; i < table.rows(); ++i) {
        const int m = lowest + 2 * static_cast<int>(i);
        orders_.push_back(sine ? -m : m);
        const double scale = (m == 0 ? 1.0 : 2.0) / n_phi_;
        for (Index k = 0; k < n_quarter_; ++k) {
          table(i, k) = scale * (sine ? std::sin(m * grid.phi[k]) : std::cos(m * grid.phi[k]));
        }
        if (n_phi_ % 4 == 0 && sine == (m % 2 == 0)) table(i, n_quarter_ - 1) = 0.0;  // π/2
      }
      tables_.push_back(std::move(table));
    }
  }
}

void LongitudeSums::run(const double* rows, Index width, const Latitude& latitude, double* amplitudes) const {
  const int half = n_phi_ / 2;
  std::vector<double> sums(static_cast<std::size_t>(4 * n_quarter_ * kPiece));
  const auto n_modes = std::ssize(orders_);
  for (Index first = 0; first < width; first += kPiece) {
    const Index columns = std::min(kPiece, width - first);
    const auto sum = [&](int family, Index k) { return sums.data() + (family * n_quarter_ + k) * columns; };
    for (Index k = 0; k < n_quarter_; ++k) {
      const auto at = [&](Index longitude) { return rows + longitude * width + first; };
      const double *here = at(k), *opposite = at(k + half);
      double *ce = sum(0, k), *co = sum(1, k), *se = sum(2, k), *so = sum(3, k);
      if (k == 0 || 2 * k == half) {
        // Two of the four longitudes coincide; the sums that should cancel are multiplied by zeros.
#pragma omp simd
        for (Index c = 0; c < columns; ++c) {
          ce[c] = se[c] = here[c] + opposite[c];
          co[c] = so[c] = here[c] - opposite[c];
        }
        continue;
      }
      const double *across = at(half - k), *below = at(n_phi_ - k);
#pragma omp simd
      for (Index c = 0; c < columns; ++c) {
        const double even = here[c] + opposite[c], odd = here[c] - opposite[c];
        const double even_image = across[c] + below[c], odd_image = across[c] - below[c];
        ce[c] = even + even_image;
        co[c] = odd - odd_image;
        se[c] = even - even_image;
        so[c] = odd + odd_image;
      }
    }
    double* to = amplitudes + (first * latitude.count + latitude.index * columns) * n_modes;
    // The destination of the next piece is in no cache, and the processor cannot predict it.
    const Index next = first + columns, next_columns = std::min(kPiece, width - next);
    prefetch_to_write(amplitudes + (next * latitude.count + latitude.index * next_columns) * n_modes,
                      next_columns * n_modes);
    for (int i = 0; i < 4; ++i) {
      const RowMatrix& table = tables_[static_cast<std::size_t>(i)];
      small_product(table.rows(), n_quarter_, columns, {table.data(), n_quarter_, 1}, sum(i, 0), columns, to, columns);
      to += table.rows() * columns;
    }
  }
}

}  // namespace vehd
