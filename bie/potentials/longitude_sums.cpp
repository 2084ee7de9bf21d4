#include "bie/potentials/longitude_sums.hpp"

#include <algorithm>
#include <cmath>

#include "bie/support/errors.hpp"

namespace vehd {

LongitudeSums::LongitudeSums(const SphereGrid& grid, int order)
    : n_phi_(grid.n_phi), order_(order), n_quarter_(grid.n_phi / 4 + 1) {
  require_size("longitudes (even)", grid.n_phi % 2, 0);
  for (const bool sine : {false, true}) {
    for (const int parity : {0, 1}) {
      Family family;
      for (int m = parity; m <= order; m += 2) {
        if (!sine || m > 0) family.modes.push_back(sine ? order + m : m);
      }
      family.table.resize(static_cast<Index>(family.modes.size()), n_quarter_);
      for (Index i = 0; i < family.table.rows(); ++i) {
        const auto m = static_cast<int>(sine ? family.modes[i] - order : family.modes[i]);
        const double scale = (m == 0 ? 1.0 : 2.0) / n_phi_;
        for (Index k = 0; k < n_quarter_; ++k) {
          family.table(i, k) = scale * (sine ? std::sin(m * grid.phi[k]) : std::cos(m * grid.phi[k]));
        }
        if (n_phi_ % 4 == 0 && sine == (m % 2 == 0)) family.table(i, n_quarter_ - 1) = 0.0;  // π/2
      }
      families_.push_back(std::move(family));
    }
  }
}

void LongitudeSums::run(const double* rows, Index width, const std::vector<double*>& modes,
                        const Latitude& latitude) const {
  const int half = n_phi_ / 2;
  std::vector<double> sums(static_cast<std::size_t>(4 * n_quarter_ * kPiece));
  std::vector<double> amplitudes(static_cast<std::size_t>((order_ / 2 + 1) * kPiece));
  for (Index first = 0; first < width; first += kPiece) {
    const Index columns = std::min(kPiece, width - first);
    const auto sum = [&](int family, Index k) { return sums.data() + (family * n_quarter_ + k) * columns; };
    for (Index k = 0; k < n_quarter_; ++k) {
      const auto at = [&](Index longitude) { return rows + longitude * width + first; };
      const double *here = at(k), *opposite = at(k + half);
      double *ce = sum(0, k), *co = sum(1, k), *se = sum(2, k), *so = sum(3, k);
      if (k == 0 || 2 * k == half) {
        // Two of the four longitudes coincide; the sums that these would cancel from are multiplied with zeros.
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
    for (int i = 0; i < 4; ++i) {
      const Family& family = families_[i];
      small_product(family.table.rows(), n_quarter_, columns, {family.table.data(), n_quarter_, 1}, sum(i, 0), columns,
                    amplitudes.data(), columns);
      for (Index row = 0; row < family.table.rows(); ++row) {
        std::copy_n(amplitudes.data() + row * columns, columns,
                    modes[family.modes[row]] + first * latitude.count + latitude.index * columns);
      }
    }
  }
}

}  // namespace vehd
