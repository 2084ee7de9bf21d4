// The part of TargetRows on the rotated grid: Legendre and Fourier sums, kernels, and the adjoint sums.
#include <algorithm>
#include <array>
#include <cmath>

#include "bie/potentials/few_nodes.hpp"
#include "bie/potentials/target_rows.hpp"
#include "bie/sphere/small_product.hpp"

namespace vehd {

namespace {

/// Part of a table of Fourier sums and the orders that belong to it.
struct FourierTable {
  const RowMatrix& table;
  bool sine;
  int first_order;  ///< sin 0φ vanishes

  [[nodiscard]] Index skipped() const { return first_order / 2; }
  [[nodiscard]] Index n_orders() const { return table.cols() - skipped(); }
  [[nodiscard]] Factor synthesis() const { return {table.data() + skipped(), table.cols(), 1}; }
  [[nodiscard]] Factor adjoint() const { return {table.data() + skipped(), 1, table.cols()}; }
};

std::array<FourierTable, 4> fourier_tables(const RotatedQuadrature& q) {
  return {{{q.cosine_even, false, 0}, {q.cosine_odd, false, 1}, {q.sine_even, true, 2}, {q.sine_odd, true, 1}}};
}

/// Table T of degrees m + parity, m + parity + 2, ... on one hemisphere.
struct HalfLegendre {
  Factor synthesis;
  Index n_degrees;

  HalfLegendre(const RotatedQuadrature& q, int kind, int m, int parity)
      : synthesis{q.synthesis[m].data() + kind * q.n_theta * (q.order + 1 - m) + parity, q.order + 1 - m, 2},
        n_degrees((q.order - m - parity + 2) / 2) {}
  [[nodiscard]] Factor adjoint() const { return {synthesis.data, synthesis.column_stride, synthesis.row_stride}; }
};

}  // namespace

/// Amplitudes of the shape data along all latitudes. T and mT/sin θ have the parity (−1)^(n+m) about the equator, dT/dθ
/// the opposite one.
void TargetRows::legendre_synthesis(int kind, bool sine) {
  const Index columns = rotated_shape_.columns(sine);
  const Index n_half = (q_.n_theta + 1) / 2;
  // ∂/∂φ takes cosines to minus sines, sines to cosines.
  const bool into_sine = (kind == 2) != sine;
  const double sign = kind == 2 && !sine ? -1.0 : 1.0;
  const double south = kind == 1 ? -sign : sign;
  for (int m = sine ? 1 : 0; m <= order_; ++m) {
    for (const int parity : {0, 1}) {
      const HalfLegendre table(q_, kind, m, parity);
      const Index n_degrees = places_.degrees.shape[(m + parity) % 2] ? table.n_degrees : 0;
      small_product(n_half, n_degrees, columns, table.synthesis, rotated_shape_.row(sine, m, m) + parity * columns,
                    2 * columns, half_[parity].data(), columns);
    }
    for (Index i = 0; i < n_half; ++i) {
      const double* even = half_[0].data() + i * columns;
      const double* odd = half_[1].data() + i * columns;
      const int mirror_image = q_.n_theta - 1 - static_cast<int>(i);
      double* to_north = shape_amplitudes_[kind].of_order(into_sine, static_cast<int>(i), m);
      if (mirror_image > i && !inverted_) {
        double* to_south = shape_amplitudes_[kind].of_order(into_sine, mirror_image, m);
#pragma omp simd
        for (Index c = 0; c < columns; ++c) to_south[c] = south * (even[c] - odd[c]);
      }
#pragma omp simd
      for (Index c = 0; c < columns; ++c) to_north[c] = sign * (even[c] + odd[c]);
    }
  }
}

void TargetRows::fourier_synthesis(int kind, int i) {
  AzimuthalAmplitudes& amplitudes = shape_amplitudes_[kind];
  int part = 0;
  for (const FourierTable& fourier : fourier_tables(q_)) {
    const Index columns = amplitudes.columns(fourier.sine);
    small_product(n_quarter_, fourier.n_orders(), columns, fourier.synthesis(),
                  amplitudes.of_order(fourier.sine, i, fourier.first_order), columns, shape_parts_[kind][part].data(),
                  columns);
    ++part;
  }
}

/// Shape data at azimuths φ, π − φ, π + φ, −φ; for targets in a mirror plane at the first two.
template <int kWidth>
void TargetRows::load_nodes(Index quarter_node, Index first, Nodes<kWidth>& nodes) const {
  for (int kind = 0; kind < shape_kinds_; ++kind) {
    const auto& parts = shape_parts_[static_cast<std::size_t>(kind)];
    const auto part = [&](std::size_t which, std::size_t position) {
      const Index columns = shape_amplitudes_[static_cast<std::size_t>(kind)].columns(which >= 2);
      return Lanes<kWidth>::load(parts[which].data() + quarter_node * columns + static_cast<Index>(position) * chunk_ +
                                 first);
    };
    const auto node = [&](std::size_t image, std::size_t component) -> auto& {
      return nodes[image][static_cast<std::size_t>(kind) * 3 + component];
    };
    if (!mirrored_) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto ce = part(0, c), co = part(1, c), se = part(2, c), so = part(3, c);
        const auto even = ce + co, odd = ce - co, plus = se + so, minus = se - so;
        node(0, c) = even + plus;
        node(1, c) = odd - minus;
        node(2, c) = odd + minus;
        node(3, c) = even - plus;
      }
      continue;
    }
    const auto& cosines = components_.of(kind == 2);
    for (std::size_t c = 0; c < cosines.size(); ++c) {
      node(0, static_cast<std::size_t>(cosines[c])) = part(0, c) + part(1, c);
      node(1, static_cast<std::size_t>(cosines[c])) = part(0, c) - part(1, c);
    }
    const auto& sines = components_.of(kind != 2);
    for (std::size_t c = 0; c < sines.size(); ++c) {
      node(0, static_cast<std::size_t>(sines[c])) = part(3, c) + part(2, c);
      node(1, static_cast<std::size_t>(sines[c])) = part(3, c) - part(2, c);
    }
  }
}

/// Adjoint of load_nodes for kernel values.
template <int kWidth>
void TargetRows::add_values(Index quarter_node, Index first, const Values<kWidth>& values) {
  const auto put = [&](std::size_t which, std::size_t position, const auto& lanes) {
    Lanes<kWidth>::store(row_parts_[which].data() + quarter_node * rows_.columns(which >= 2) +
                             static_cast<Index>(position) * chunk_ + first,
                         lanes);
  };
  if (!mirrored_) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(kernels_.count); ++c) {
      const auto right = values[0][c] + values[3][c], left = values[1][c] + values[2][c];
      const auto up = values[0][c] - values[3][c], down = values[1][c] - values[2][c];
      put(0, c, right + left);
      put(1, c, right - left);
      put(2, c, up - down);
      put(3, c, up + down);
    }
    return;
  }
  for (const bool sine : {false, true}) {
    const auto& columns = kernel_columns_.of(sine);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const auto kernel = static_cast<std::size_t>(columns[c]);
      put(sine ? 3 : 0, c, 2.0 * (values[0][kernel] + values[1][kernel]));
      put(sine ? 2 : 1, c, 2.0 * (values[0][kernel] - values[1][kernel]));
    }
  }
}

/// Evaluates all images of a node for kWidth targets of the chunk.
template <int kWidth>
void TargetRows::evaluate_node(Index quarter_node, Index first, double weight) {
  Nodes<kWidth> nodes;
  Values<kWidth> values;
  load_nodes<kWidth>(quarter_node, first, nodes);
  for (std::size_t image = 0; image < n_images_; ++image) {
    node_kernels_.evaluate<kWidth>(first, nodes[image], weight, values[image]);
    if (!inverted_) continue;
    // The opposite node lies at −x with −J n, and all harmonics have the opposite value there.
    for (std::size_t i = 0; i < 6; ++i) nodes[image][i] = -nodes[image][i];  // x and ∂x/∂θ
    NodeKernels::Values<kWidth> opposite;
    node_kernels_.evaluate<kWidth>(first, nodes[image], weight, opposite);
    for (std::size_t c = 0; c < static_cast<std::size_t>(kernels_.count); ++c) values[image][c] -= opposite[c];
  }
  add_values<kWidth>(quarter_node, first, values);
}

void TargetRows::evaluate_latitude(int i) {
  for (int kind = 0; kind < shape_kinds_; ++kind) fourier_synthesis(kind, i);
  // Pairs of opposite nodes on the equator would be counted twice.
  const bool twice = inverted_ && 2 * i + 1 == q_.n_theta;
  const double weight = twice ? 0.5 * q_.weight[i] : q_.weight[i];
  for (Index quarter_node = 0; quarter_node < n_quarter_; ++quarter_node) {
    // Registers of this processor, and shorter ones for the remainder.
    constexpr auto kWide = static_cast<int>(kTogether);
    Index first = 0;
    for (; first + kWide <= chunk_; first += kWide) evaluate_node<kWide>(quarter_node, first, weight);
    if constexpr (kWide > kLanes) {
      if (first < chunk_) evaluate_node<kLanes>(quarter_node, first, weight);
    }
  }
  fourier_adjoint(i);
}

void TargetRows::fourier_adjoint(int i) {
  int part = 0;
  for (const FourierTable& fourier : fourier_tables(q_)) {
    const Index columns = row_amplitudes_.columns(fourier.sine);
    small_product(fourier.n_orders(), n_quarter_, columns, fourier.adjoint(), row_parts_[part].data(), columns,
                  row_amplitudes_.of_order(fourier.sine, i, fourier.first_order), columns);
    ++part;
  }
}

/// D′ acts on f − f(x). At the pole only harmonics of order 0 differ from zero, that of degree n being √(2n + 1) times
/// the constant one.
void TargetRows::subtract_pole() {
  const Index place =
      std::ranges::find(kernel_columns_.cosine, kernels_.hypersingular) - kernel_columns_.cosine.begin();
  const double* of_constant = rotated_rows_.row(false, 0, 0) + place * chunk_;
  for (int n = order_; n >= 0; --n) {
    double* row = rotated_rows_.row(false, n, 0) + place * chunk_;
    for (Index t = 0; t < chunk_; ++t) row[t] -= std::sqrt(2.0 * n + 1.0) * of_constant[t];
  }
}

void TargetRows::legendre_adjoint(bool sine) {
  const Index columns = rotated_rows_.columns(sine);
  const Index n_half = (q_.n_theta + 1) / 2;
  for (int m = sine ? 1 : 0; m <= order_; ++m) {
    for (Index i = 0; i < n_half; ++i) {
      double* even = half_[0].data() + i * columns;
      double* odd = half_[1].data() + i * columns;
      const int mirror_image = q_.n_theta - 1 - static_cast<int>(i);
      const double* north = row_amplitudes_.of_order(sine, static_cast<int>(i), m);
      // The equator is its own image, and odd harmonics vanish there.
      const bool has_south = mirror_image > i && !inverted_;
      const double* south = has_south ? row_amplitudes_.of_order(sine, mirror_image, m) : north;
      const double share = has_south ? 1.0 : 0.0;
#pragma omp simd
      for (Index c = 0; c < columns; ++c) {
        even[c] = north[c] + share * south[c];
        odd[c] = north[c] - share * south[c];
      }
    }
    for (const int parity : {0, 1}) {
      if (!places_.degrees.rows[(m + parity) % 2]) continue;
      const HalfLegendre table(q_, 0, m, parity);
      small_product(table.n_degrees, n_half, columns, table.adjoint(), half_[parity].data(), columns,
                    rotated_rows_.row(sine, m, m) + parity * columns, 2 * columns);
    }
  }
}

}  // namespace vehd
