#include "bie/sphere/fourier.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include "bie/sphere/small_product.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/lanes.hpp"

namespace vehd {

namespace {

/// Longitudes of axisymmetric fields, where sines and cosines are 0 and ±1.
constexpr int kQuarterTurns = 4;
/// Most latitudes whose sums, eight each with their mirror images, stay in registers; longitudes per register.
#ifdef __AVX512F__
constexpr int kMostLatitudes = 3;
constexpr int kWidest = 2 * kLanes;
#else
constexpr int kMostLatitudes = 1;
constexpr int kWidest = kLanes;
#endif
/// Up to this order products are faster than fast transforms: measured without AVX, and with AVX at all degrees up to
/// 64, where they take half the time.
#ifdef __AVX__
constexpr int kMostByProducts = 128;
#else
constexpr int kMostByProducts = 32;
#endif

/// Workspace of `count` numbers, one per thread. Rows are summed so often that allocation would take noticeable time.
double* thread_workspace(Index count) {
  thread_local std::unique_ptr<double[]> numbers;
  thread_local Index n_numbers = 0;
  if (count > n_numbers) {
    numbers = std::make_unique_for_overwrite<double[]>(count);
    n_numbers = count;
  }
  return numbers.get();
}

template <int kWidth>
using Longitudes = typename Lanes<kWidth>::Values;

Longitudes<4> reversed(const Longitudes<4>& lanes) { return __builtin_shufflevector(lanes, lanes, 3, 2, 1, 0); }
#ifdef __AVX512F__
Longitudes<8> reversed(const Longitudes<8>& lanes) {
  return __builtin_shufflevector(lanes, lanes, 7, 6, 5, 4, 3, 2, 1, 0);
}
#endif

/// Sums over even and odd orders of cosines and sines on one latitude, over longitudes of a quarter of the circle.
template <int kWidth>
struct QuarterSums {
  Longitudes<kWidth> even_cosines, odd_cosines, even_sines, odd_sines;
};

/// Writes one row at longitudes φ, π − φ, π + φ and −φ, for kWidth values of φ from index `at` of the quarter on.
template <int kWidth>
void unfold(const QuarterSums<kWidth>& sums, Index at, Index n_phi, double* values) {
  const auto put = [](double* to, const Longitudes<kWidth>& lanes) { Lanes<kWidth>::store(to, lanes); };
  double *here = values + at, *opposite = here + n_phi / 2;
  double *before_opposite = values + n_phi / 2 - at - (kWidth - 1), *below = before_opposite + n_phi / 2;
  const Longitudes<kWidth> cosines = sums.even_cosines + sums.odd_cosines, sines = sums.even_sines + sums.odd_sines;
  const Longitudes<kWidth> opposite_cosines = sums.even_cosines - sums.odd_cosines;
  const Longitudes<kWidth> opposite_sines = sums.even_sines - sums.odd_sines;
  put(here, cosines + sines);
  put(opposite, opposite_cosines + opposite_sines);
  // Sines of 0 are 0, so that φ = π gets the same value twice; φ = 2π is beyond the row.
  put(before_opposite, reversed(opposite_cosines - opposite_sines));
  const Longitudes<kWidth> mirrored = reversed(cosines - sines);
  if (at == 0) {
    std::memcpy(below, &mirrored, sizeof mirrored - sizeof(double));
  } else {
    put(below, mirrored);
  }
}

/// unfold() for a quarter that does not fill a register.
void unfold_few(const QuarterSums<kLanes>& sums, Index n_quarter, Index n_phi, double* values) {
  double *here = values, *opposite = values + n_phi / 2, *below = values + n_phi;
  for (Index k = 0; k < n_quarter; ++k) {
    const double cosines = sums.even_cosines[k] + sums.odd_cosines[k], sines = sums.even_sines[k] + sums.odd_sines[k];
    const double opposite_cosines = sums.even_cosines[k] - sums.odd_cosines[k];
    const double opposite_sines = sums.even_sines[k] - sums.odd_sines[k];
    here[k] = cosines + sines;
    opposite[k] = opposite_cosines + opposite_sines;
    if (k == 0) continue;
    opposite[-k] = opposite_cosines - opposite_sines;
    below[-k] = cosines - sines;
  }
}

/// Combinations of the values of one row at φ, π − φ, π + φ and −φ that enter even and odd orders of cosines and sines.
template <typename Number>
struct Folded {
  Number even_cosines, odd_cosines, even_sines, odd_sines;

  Folded(const Number& here, const Number& before_opposite, const Number& opposite, const Number& below) {
    const Number even = here + opposite, odd = here - opposite;
    const Number even_image = before_opposite + below, odd_image = before_opposite - below;
    even_cosines = even + even_image;
    odd_cosines = odd - odd_image;
    even_sines = even - even_image;
    odd_sines = odd + odd_image;
  }
};

/// Destination rows of the folded sums.
struct FoldedRows {
  double *even_cosines, *odd_cosines, *even_sines, *odd_sines;
};

/// Values of one latitude without or with those of its mirror image.
struct Alone {
  const double* row;
  template <int kWidth>
  [[nodiscard]] Longitudes<kWidth> lanes(Index k) const {
    return Lanes<kWidth>::load(row + k);
  }
  [[nodiscard]] double one(Index k) const { return row[k]; }
};
template <int kSign>
struct WithImage {
  const double *row, *image;
  template <int kWidth>
  [[nodiscard]] Longitudes<kWidth> lanes(Index k) const {
    const Longitudes<kWidth> own = Lanes<kWidth>::load(row + k), of_image = Lanes<kWidth>::load(image + k);
    return kSign > 0 ? own + of_image : own - of_image;
  }
  [[nodiscard]] double one(Index k) const { return kSign > 0 ? row[k] + image[k] : row[k] - image[k]; }
};

/// Folds longitudes 1 to end − 1, which fill at least one register.
template <int kWidth, typename Values>
void fold_registers(const Values& values, Index end, Index n_phi, const FoldedRows& to) {
  const Index half = n_phi / 2;
  // Rows are so short that a scalar remainder would take as long as the rest: the last registers overlap others.
  for (Index k = 1; k < end; k += kWidth) {
    const Index at = std::min<Index>(k, end - kWidth), mirrored = at + kWidth - 1;
    const auto lanes = [&](Index first) { return values.template lanes<kWidth>(first); };
    const Folded<Longitudes<kWidth>> sums(lanes(at), reversed(lanes(half - mirrored)), lanes(half + at),
                                          reversed(lanes(n_phi - mirrored)));
    Lanes<kWidth>::store(to.even_cosines + at, sums.even_cosines);
    Lanes<kWidth>::store(to.odd_cosines + at, sums.odd_cosines);
    Lanes<kWidth>::store(to.even_sines + at, sums.even_sines);
    Lanes<kWidth>::store(to.odd_sines + at, sums.odd_sines);
  }
}

template <typename Values>
void fold(const Values& values, Index n_quarter, Index n_phi, const FoldedRows& to) {
  const Index half = n_phi / 2;
  // Where two of the four longitudes coincide, the sums that should cancel are multiplied by zeros of the tables.
  const auto fold_pair = [&](Index k) {
    const double here = values.one(k), opposite = values.one(half + k);
    to.even_cosines[k] = to.even_sines[k] = here + opposite;
    to.odd_cosines[k] = to.odd_sines[k] = here - opposite;
  };
  const Index end = n_phi % 4 == 0 ? n_quarter - 1 : n_quarter;
  fold_pair(0);
  if (end < n_quarter) fold_pair(end);
  if (end - 1 >= kWidest) return fold_registers<kWidest>(values, end, n_phi, to);
  if (end - 1 >= kLanes) return fold_registers<kLanes>(values, end, n_phi, to);
  for (Index k = 1; k < end; ++k) {
    const Folded<double> sums(values.one(k), values.one(half - k), values.one(half + k), values.one(n_phi - k));
    to.even_cosines[k] = sums.even_cosines;
    to.odd_cosines[k] = sums.odd_cosines;
    to.even_sines[k] = sums.even_sines;
    to.odd_sines[k] = sums.odd_sines;
  }
}

}  // namespace

FourierSums::FourierSums(int n_phi, int order)
    : n_phi_(n_phi), order_(order), n_quarter_(n_phi / 4 + 1), row_length_(whole_registers(order / 2 + 1)) {
  require_size("longitudes (even)", n_phi % 2, 0);
  if (order > kMostByProducts) {
    fast_.emplace(n_phi, order);
    return;
  }
  const Index width = filled_up(n_quarter_);
  synthesis_ = RowMatrix::Zero(order + 1, kWaves * width);
  for (auto& of_parity : analysis_) of_parity.fill(RowMatrix::Zero(n_quarter_, row_length_));
  for (int m = 0; m <= order; ++m) {
    for (Index k = 0; k < n_quarter_; ++k) {
      const double phi = 2.0 * std::numbers::pi * static_cast<double>(k) / n_phi;
      for (const bool sine : {false, true}) {
        const bool vanishes = 4 * k == n_phi && sine == (m % 2 == 0);  // at π/2
        const double wave = vanishes ? 0.0 : sine ? std::sin(m * phi) : std::cos(m * phi);
        synthesis_(m, (sine ? width : 0) + k) = wave;
        if (sine) synthesis_(m, 2 * width + k) = -wave;
        analysis_[m % 2][sine ? 1 : 0](k, m / 2) = (m == 0 ? 1.0 : 2.0) / n_phi * wave;
      }
    }
  }
}

template <int kRows, int kWidth>
void FourierSums::synthesize_rows(Index first, Index n_theta, const HemisphereAmplitudes& amplitudes,
                                  double* values) const {
  const Index stride = amplitudes.stride, width = filled_up(n_quarter_), last = std::max<Index>(n_quarter_ - kWidth, 0);
  for (Index k = 0; k < n_quarter_; k += kWidth) {
    // Rows are so short that a scalar remainder would take as long as the rest: the last registers overlap others.
    const Index at = std::min(k, last);
    const double *cosine = synthesis_.data() + at, *sine = cosine + (amplitudes.minus_sines ? 2 : 1) * width;
    // [symmetric or antisymmetric part][parity of m][latitude].
    Longitudes<kWidth> cosines[2][2][kRows] = {}, sines[2][2][kRows] = {};
    const auto add = [&](int m, int parity) {
      const Longitudes<kWidth> of_cosine = Lanes<kWidth>::load(cosine + m * synthesis_.cols());
      const Longitudes<kWidth> of_sine = Lanes<kWidth>::load(sine + m * synthesis_.cols());
#pragma GCC unroll 2
      for (int part = 0; part < 2; ++part) {
        const double* c = amplitudes.cosines[part] + m * stride + first;
        const double* s = amplitudes.sines[part] + m * stride + first;
#pragma GCC unroll 3
        for (int r = 0; r < kRows; ++r) {
          cosines[part][parity][r] += c[r] * of_cosine;
          sines[part][parity][r] += s[r] * of_sine;
        }
      }
    };
    int m = 0;
    for (; m < order_; m += 2) {
      add(m, 0);
      add(m + 1, 1);
    }
    if (m == order_) add(m, 0);
#pragma GCC unroll 3
    for (int r = 0; r < kRows; ++r) {
      const auto put_row = [&](const QuarterSums<kWidth>& sums, Index row) {
        if constexpr (kWidth == kLanes) {
          if (n_quarter_ < kLanes) return unfold_few(sums, n_quarter_, n_phi_, values + row * n_phi_);
        }
        unfold(sums, at, n_phi_, values + row * n_phi_);
      };
      const Index row = first + r;
      // The equator is its own image: the northern row, written last, is the correct one.
      put_row({cosines[0][0][r] - cosines[1][0][r], cosines[0][1][r] - cosines[1][1][r],
               sines[0][0][r] - sines[1][0][r], sines[0][1][r] - sines[1][1][r]},
              n_theta - 1 - row);
      put_row({cosines[0][0][r] + cosines[1][0][r], cosines[0][1][r] + cosines[1][1][r],
               sines[0][0][r] + sines[1][0][r], sines[0][1][r] + sines[1][1][r]},
              row);
    }
  }
}

template <int kWidth>
void FourierSums::synthesize_by_products(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const {
  const Index n_half = (n_theta + 1) / 2;
  Index first = 0;
  for (; first + kMostLatitudes <= n_half; first += kMostLatitudes) {
    synthesize_rows<kMostLatitudes, kWidth>(first, n_theta, amplitudes, values);
  }
  if constexpr (kMostLatitudes > 2) {
    if (n_half - first == 2) return synthesize_rows<2, kWidth>(first, n_theta, amplitudes, values);
  }
  if (first < n_half) synthesize_rows<1, kWidth>(first, n_theta, amplitudes, values);
}

void FourierSums::synthesize(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const {
  if (n_phi_ == kQuarterTurns && order_ == 1) return synthesize_quarter_turns(n_theta, amplitudes, values);
  if (fast_) return synthesize_fast(n_theta, amplitudes, values);
  if (n_quarter_ < kWidest) return synthesize_by_products<kLanes>(n_theta, amplitudes, values);
  synthesize_by_products<kWidest>(n_theta, amplitudes, values);
}

void FourierSums::synthesize_quarter_turns(Index n_theta, const HemisphereAmplitudes& amplitudes,
                                           double* values) const {
  const auto put_row = [](double mean, double cosine, double sine, double* row) {
    row[0] = mean + cosine;
    row[1] = mean + sine;
    row[2] = mean - cosine;
    row[3] = mean - sine;
  };
  const Index stride = amplitudes.stride;
  const double sign = amplitudes.minus_sines ? -1.0 : 1.0;
  const auto& [symmetric, antisymmetric] = amplitudes.cosines;
  const auto& [symmetric_sine, antisymmetric_sine] = amplitudes.sines;
  for (Index i = 0; i < (n_theta + 1) / 2; ++i) {
    const double s = sign * symmetric_sine[stride + i], t = sign * antisymmetric_sine[stride + i];
    put_row(symmetric[i] - antisymmetric[i], symmetric[stride + i] - antisymmetric[stride + i], s - t,
            values + (n_theta - 1 - i) * kQuarterTurns);
    put_row(symmetric[i] + antisymmetric[i], symmetric[stride + i] + antisymmetric[stride + i], s + t,
            values + i * kQuarterTurns);
  }
}

void FourierSums::synthesize_fast(Index n_theta, const HemisphereAmplitudes& amplitudes, double* values) const {
  double* rows = thread_workspace((2 * order_ + 1) * n_theta);
  for (int m = 0; m <= order_; ++m) {
    for (const bool sine : {false, true}) {
      if (sine && m == 0) continue;
      const auto& parts = sine ? amplitudes.sines : amplitudes.cosines;
      const double sign = sine && amplitudes.minus_sines ? -1.0 : 1.0;
      double* to = rows + (sine ? order_ + m : m) * n_theta;
      for (Index i = 0; i < (n_theta + 1) / 2; ++i) {
        const double symmetric = parts[0][m * amplitudes.stride + i], other = parts[1][m * amplitudes.stride + i];
        to[n_theta - 1 - i] = sign * (symmetric - other);
        to[i] = sign * (symmetric + other);
      }
    }
  }
  fast_->synthesize(n_theta, rows, n_theta, values);
}

void FourierSums::analyze(Index n_theta, const double* values, const AnalysedAmplitudes& amplitudes) const {
  if (n_phi_ == kQuarterTurns && order_ == 1) return analyze_quarter_turns(n_theta, values, amplitudes);
  if (fast_) return analyze_fast(n_theta, values, amplitudes);
  const Index n_half = (n_theta + 1) / 2, size = n_half * n_quarter_;
  double* folded = thread_workspace(AnalysedAmplitudes::kBlocks * size);
  const auto place = [&](int part, int parity, bool sine) {
    return folded + AnalysedAmplitudes::number(part, parity, sine) * size;
  };
  for (Index i = 0; i < n_half; ++i) {
    const auto rows = [&](int part) {
      const Index at = i * n_quarter_;
      return FoldedRows{place(part, 0, false) + at, place(part, 1, false) + at, place(part, 0, true) + at,
                        place(part, 1, true) + at};
    };
    const double *north = values + i * n_phi_, *south = values + (n_theta - 1 - i) * n_phi_;
    if (north == south) {
      for (const int part : {0, 1}) fold(Alone{north}, n_quarter_, n_phi_, rows(part));
    } else {
      fold(WithImage<1>{north, south}, n_quarter_, n_phi_, rows(0));
      fold(WithImage<-1>{north, south}, n_quarter_, n_phi_, rows(1));
    }
  }
  for (const int part : {0, 1}) {
    for (const int parity : {0, 1}) {
      for (const bool sine : {false, true}) {
        const RowMatrix& table = analysis_[parity][sine ? 1 : 0];
        const int number = AnalysedAmplitudes::number(part, parity, sine);
        small_product(n_half, n_quarter_, row_length_, {folded + number * size, n_quarter_, 1}, table.data(),
                      row_length_, amplitudes.data + number * amplitudes.block, row_length_);
      }
    }
  }
}

void FourierSums::analyze_quarter_turns(Index n_theta, const double* values,
                                        const AnalysedAmplitudes& amplitudes) const {
  for (Index i = 0; i < (n_theta + 1) / 2; ++i) {
    const double *north = values + i * kQuarterTurns, *south = values + (n_theta - 1 - i) * kQuarterTurns;
    for (const int part : {0, 1}) {
      const double sign = north == south ? 0.0 : part == 0 ? 1.0 : -1.0;
      const auto value = [&](int k) { return north[k] + sign * south[k]; };
      const auto to = [&](int m, bool sine) {
        return amplitudes.data + AnalysedAmplitudes::number(part, m, sine) * amplitudes.block + i * row_length_;
      };
      *to(0, false) = 0.25 * ((value(0) + value(2)) + (value(1) + value(3)));
      *to(1, false) = 0.5 * (value(0) - value(2));
      *to(1, true) = 0.5 * (value(1) - value(3));
    }
  }
}

void FourierSums::analyze_fast(Index n_theta, const double* values, const AnalysedAmplitudes& amplitudes) const {
  const Index n_modes = 2 * order_ + 1;
  double* rows = thread_workspace(n_modes * n_theta);
  fast_->analyze(n_theta, values, rows);
  for (Index i = 0; i < (n_theta + 1) / 2; ++i) {
    const double *north = rows + i * n_modes, *south = rows + (n_theta - 1 - i) * n_modes;
    for (int m = 0; m <= order_; ++m) {
      for (const bool sine : {false, true}) {
        if (sine && m == 0) continue;
        const Index mode = sine ? order_ + m : m;
        for (const int part : {0, 1}) {
          const double sign = north == south ? 0.0 : part == 0 ? 1.0 : -1.0;
          double* block = amplitudes.data + AnalysedAmplitudes::number(part, m, sine) * amplitudes.block;
          block[i * row_length_ + m / 2] = north[mode] + sign * south[mode];
        }
      }
    }
  }
}

}  // namespace vehd
