#include "bie/sphere/fourier.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include "bie/sphere/small_product.hpp"
#include "bie/support/errors.hpp"

#ifndef __AVX__
// Vectors of four numbers are passed between functions of this file alone, whatever others agree on.
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace vehd {

namespace {

/// Longitudes of axisymmetric fields, where sines and cosines are 0 and ±1.
constexpr int kQuarterTurns = 4;
/// Rows whose parts stay in the first-level cache. A few more stay with them: grids have one latitude more than their
/// degree says, and alone it would take as long as eight.
constexpr Index kRowsTogether = 16;
constexpr Index kMostTogether = kRowsTogether + kRowsTogether / 2;

Index next_rows(Index left) { return left > kMostTogether ? kRowsTogether : left; }
/// Up to this order products take less than fast transforms: measured without AVX, and with it at all degrees up to 64,
/// where they take half as long (docs/performance.md).
#ifdef __AVX__
constexpr int kMostByProducts = 128;
#else
constexpr int kMostByProducts = 32;
#endif

/// So many numbers that are read by nobody else. Rows are summed so often that asking for memory shows.
double* of_this_thread(Index count) {
  thread_local std::unique_ptr<double[]> numbers;
  thread_local Index n_numbers = 0;
  if (count > n_numbers) {
    numbers = std::make_unique_for_overwrite<double[]>(count);
    n_numbers = count;
  }
  return numbers.get();
}

using Longitudes [[gnu::vector_size(kLanes * sizeof(double))]] = double;

Longitudes longitudes(const double* at) {
  Longitudes lanes;
  std::memcpy(&lanes, at, sizeof lanes);
  return lanes;
}

Longitudes reversed(const Longitudes& lanes) { return __builtin_shufflevector(lanes, lanes, 3, 2, 1, 0); }

}  // namespace

FourierSums::FourierSums(int n_phi, int order) : n_phi_(n_phi), order_(order), n_quarter_(n_phi / 4 + 1) {
  require_size("longitudes (even)", n_phi % 2, 0);
  if (order > kMostByProducts) {
    fast_.emplace(n_phi, order);
    return;
  }
  for (int i = 0; i < kFamilies; ++i) {
    Family& family = families_[static_cast<std::size_t>(i)];
    const bool sine = i >= 2;
    const int parity = i % 2;
    const int first = sine && parity == 0 ? 2 : parity;  // sin 0φ takes no part
    family.first_mode = sine ? sine_mode(first) : cosine_mode(first);
    family.n_modes = first > order ? 0 : (order - first) / 2 + 1;
    family.synthesis = RowMatrix::Zero(family.n_modes, whole_registers(n_quarter_));
    family.analysis = RowMatrix::Zero(n_quarter_, whole_registers(family.n_modes));
    for (Index j = 0; j < family.n_modes; ++j) {
      const auto m = first + 2 * static_cast<int>(j);
      for (Index k = 0; k < n_quarter_; ++k) {
        const double phi = 2.0 * std::numbers::pi * static_cast<double>(k) / n_phi;
        const bool vanishes = 4 * k == n_phi && sine == (m % 2 == 0);  // at π/2
        const double wave = vanishes ? 0.0 : sine ? std::sin(m * phi) : std::cos(m * phi);
        family.synthesis(j, k) = wave;
        family.analysis(k, j) = (m == 0 ? 1.0 : 2.0) / n_phi * wave;
      }
    }
  }
}

/// One row at longitudes φ, π − φ, π + φ and −φ. Those that coincide get the same value twice.
void FourierSums::unfold(const std::array<const double*, kFamilies>& parts, double* values) const {
  const double *ce = parts[0], *co = parts[1], *se = parts[2], *so = parts[3];
  double *here = values, *opposite = values + n_phi_ / 2, *below = values + n_phi_;
  if (n_quarter_ <= kLanes) {
    for (Index k = 0; k < n_quarter_; ++k) {
      here[k] = (ce[k] + co[k]) + (se[k] + so[k]);
      opposite[k] = (ce[k] - co[k]) + (se[k] - so[k]);
      if (k == 0) continue;
      opposite[-k] = (ce[k] - co[k]) - (se[k] - so[k]);
      below[-k] = (ce[k] + co[k]) - (se[k] + so[k]);
    }
    return;
  }
  // Rows are so short that what is left over would take as long as all else: the last registers overlap others.
  const Index last = n_quarter_ - kLanes;
  const auto put = [](double* to, const Longitudes& lanes) { std::memcpy(to, &lanes, sizeof lanes); };
  for (Index k = 0; k < n_quarter_; k += kLanes) {
    const Index at = std::min(k, last);
    const Longitudes c = longitudes(ce + at), d = longitudes(co + at);
    const Longitudes s = longitudes(se + at), t = longitudes(so + at);
    const Longitudes cosines = c + d, opposite_cosines = c - d, sines = s + t, opposite_sines = s - t;
    put(here + at, cosines + sines);
    put(opposite + at, opposite_cosines + opposite_sines);
    // Sines of 0 are 0, so that φ = π gets the same value twice; φ = 2π is beyond the row.
    put(opposite - at - (kLanes - 1), reversed(opposite_cosines - opposite_sines));
    const Longitudes mirrored = reversed(cosines - sines);
    double* to = below - at - (kLanes - 1);
    if (at == 0) {
      std::memcpy(to, &mirrored, sizeof mirrored - sizeof(double));
    } else {
      put(to, mirrored);
    }
  }
}

/// The other way for the sums of a row.
void FourierSums::fold(const double* values, const std::array<double*, kFamilies>& parts) const {
  double *ce = parts[0], *co = parts[1], *se = parts[2], *so = parts[3];
  const Index half = n_phi_ / 2;
  const double *here = values, *opposite = values + half, *across = values + half, *below = values + n_phi_;
  // Where two of the four longitudes coincide, what these would cancel from meets zeros in the tables.
  const auto fold_pair = [&](Index k) {
    ce[k] = se[k] = here[k] + opposite[k];
    co[k] = so[k] = here[k] - opposite[k];
  };
  const Index end = n_phi_ % 4 == 0 ? n_quarter_ - 1 : n_quarter_;
  fold_pair(0);
  if (end < n_quarter_) fold_pair(end);
#pragma omp simd
  for (Index k = 1; k < end; ++k) {
    const double even = here[k] + opposite[k], odd = here[k] - opposite[k];
    const double even_image = across[-k] + below[-k], odd_image = across[-k] - below[-k];
    ce[k] = even + even_image;
    co[k] = odd - odd_image;
    se[k] = even - even_image;
    so[k] = odd + odd_image;
  }
}

void FourierSums::synthesize(Index rows, const double* amplitudes, Index stride, double* values) const {
  if (n_phi_ == kQuarterTurns && order_ == 1) {
    const double *mean = amplitudes, *cosine = amplitudes + stride, *sine = amplitudes + 2 * stride;
    for (Index i = 0; i < rows; ++i, values += kQuarterTurns) {
      values[0] = mean[i] + cosine[i];
      values[1] = mean[i] + sine[i];
      values[2] = mean[i] - cosine[i];
      values[3] = mean[i] - sine[i];
    }
    return;
  }
  if (fast_) return fast_->synthesize(rows, amplitudes, stride, values);
  const Index width = whole_registers(n_quarter_);
  double* buffer = of_this_thread(kFamilies * kMostTogether * width);
  const auto part = [&](int family, Index row) { return buffer + (family * kMostTogether + row) * width; };
  for (Index first = 0, count = 0; first < rows; first += count) {
    count = next_rows(rows - first);
    for (int i = 0; i < kFamilies; ++i) {
      const Family& family = families_[static_cast<std::size_t>(i)];
      small_product(count, family.n_modes, width, {amplitudes + family.first_mode * stride + first, 1, 2 * stride},
                    family.synthesis.data(), width, part(i, 0), width);
    }
    for (Index row = 0; row < count; ++row) {
      unfold({part(0, row), part(1, row), part(2, row), part(3, row)}, values + (first + row) * n_phi_);
    }
  }
}

void FourierSums::analyze(Index rows, const double* values, double* amplitudes) const {
  if (n_phi_ == kQuarterTurns && order_ == 1) {
    for (Index i = 0; i < rows; ++i, values += kQuarterTurns, amplitudes += 3) {
      amplitudes[0] = 0.25 * ((values[0] + values[2]) + (values[1] + values[3]));
      amplitudes[1] = 0.5 * (values[0] - values[2]);
      amplitudes[2] = 0.5 * (values[1] - values[3]);
    }
    return;
  }
  if (fast_) return fast_->analyze(rows, values, amplitudes);
  const Index n_parts = kFamilies * kMostTogether * n_quarter_;
  double* buffer = of_this_thread(n_parts + kMostTogether * whole_registers(order_ / 2 + 1));
  double* sums = buffer + n_parts;
  const auto part = [&](int family, Index row) { return buffer + (family * kMostTogether + row) * n_quarter_; };
  for (Index first = 0, count = 0; first < rows; first += count) {
    count = next_rows(rows - first);
    for (Index row = 0; row < count; ++row) {
      fold(values + (first + row) * n_phi_, {part(0, row), part(1, row), part(2, row), part(3, row)});
    }
    for (int i = 0; i < kFamilies; ++i) {
      const Family& family = families_[static_cast<std::size_t>(i)];
      const Index width = family.analysis.cols();
      small_product(count, n_quarter_, width, {part(i, 0), n_quarter_, 1}, family.analysis.data(), width, sums, width);
      for (Index row = 0; row < count; ++row) {
        double* to = amplitudes + (first + row) * n_modes() + family.first_mode;
        for (Index j = 0; j < family.n_modes; ++j) to[2 * j] = sums[row * width + j];
      }
    }
  }
}

}  // namespace vehd
