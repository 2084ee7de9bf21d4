#include "bie/potentials/azimuth_sums.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Columns at a time: what is summed over them stays in cache.
constexpr Index kColumns = 24 * kLanes;

}  // namespace

AzimuthSums::AzimuthSums(int n_phi, int order) : n_phi_(n_phi), order_(order) {
  require_size("azimuths (a multiple of four)", n_phi % 4, 0);
  for (const bool sine : {false, true}) {
    for (const int parity : {0, 1}) {
      Family& family = families_[static_cast<std::size_t>(2 * sine + parity)];
      const int lowest = sine && parity == 0 ? 2 : parity;
      family.first = sine ? order + lowest : lowest;
      family.count = std::max(0, (order - lowest + 2) / 2);
      family.table.resize(n_phi / 4, family.count);
      for (Index k = 0; k < family.table.rows(); ++k) {
        const double psi = (static_cast<double>(k) + 0.5) * 2.0 * std::numbers::pi / n_phi;
        for (Index i = 0; i < family.count; ++i) {
          const double m = lowest + 2.0 * static_cast<double>(i);
          family.table(k, i) = sine ? std::sin(m * psi) : std::cos(m * psi);
        }
      }
    }
  }
}

RowMatrix AzimuthSums::values(const RowMatrix& amplitudes) const {
  require_size("amplitudes", amplitudes.rows(), n_modes());
  const Index width = amplitudes.cols(), quarter = n_phi_ / 4;
  RowMatrix result(n_phi_, width);
  std::vector<double> sums(static_cast<std::size_t>(4 * quarter * kColumns));
  for (Index first = 0; first < width; first += kColumns) {
    const Index columns = std::min(kColumns, width - first);
    const auto sum = [&](Index family, Index k) { return sums.data() + (family * quarter + k) * columns; };
    for (Index f = 0; f < 4; ++f) {
      const Family& family = families_[static_cast<std::size_t>(f)];
      small_product(quarter, family.count, columns, {family.table.data(), family.count, 1},
                    amplitudes.data() + family.first * width + first, 2 * width, sum(f, 0), columns);
    }
    for (Index k = 0; k < quarter; ++k) {
      const double *ce = sum(0, k), *co = sum(1, k), *se = sum(2, k), *so = sum(3, k);
      const auto at = [&](Index azimuth) { return result.data() + azimuth * width + first; };
      double *here = at(k), *across = at(2 * quarter - 1 - k), *opposite = at(2 * quarter + k),
             *below = at(n_phi_ - 1 - k);
#pragma omp simd
      for (Index c = 0; c < columns; ++c) {
        const double even = ce[c] + co[c], even_image = ce[c] - co[c];
        const double odd = so[c] + se[c], odd_image = so[c] - se[c];
        here[c] = even + odd;
        below[c] = even - odd;
        across[c] = even_image + odd_image;
        opposite[c] = even_image - odd_image;
      }
    }
  }
  return result;
}

RowMatrix AzimuthSums::adjoint(const RowMatrix& values) const {
  require_size("values", values.rows(), n_phi_);
  const Index width = values.cols(), quarter = n_phi_ / 4;
  RowMatrix result(n_modes(), width);
  std::vector<double> sums(static_cast<std::size_t>(4 * quarter * kColumns));
  for (Index first = 0; first < width; first += kColumns) {
    const Index columns = std::min(kColumns, width - first);
    const auto sum = [&](Index family, Index k) { return sums.data() + (family * quarter + k) * columns; };
    for (Index k = 0; k < quarter; ++k) {
      const auto at = [&](Index azimuth) { return values.data() + azimuth * width + first; };
      const double *here = at(k), *across = at(2 * quarter - 1 - k), *opposite = at(2 * quarter + k),
                   *below = at(n_phi_ - 1 - k);
      double *ce = sum(0, k), *co = sum(1, k), *se = sum(2, k), *so = sum(3, k);
#pragma omp simd
      for (Index c = 0; c < columns; ++c) {
        const double even = here[c] + below[c], even_image = across[c] + opposite[c];
        const double odd = here[c] - below[c], odd_image = across[c] - opposite[c];
        ce[c] = even + even_image;
        co[c] = even - even_image;
        so[c] = odd + odd_image;
        se[c] = odd - odd_image;
      }
    }
    for (Index f = 0; f < 4; ++f) {
      const Family& family = families_[static_cast<std::size_t>(f)];
      small_product(family.count, quarter, columns, {family.table.data(), 1, family.count}, sum(f, 0), columns,
                    result.data() + family.first * width + first, 2 * width);
    }
  }
  return result;
}

}  // namespace vehd
