// What TargetRows does on the rotated grid: Legendre and Fourier sums, kernels, and the sums of these.
#include <array>

#include "bie/potentials/few_nodes.hpp"
#include "bie/potentials/target_rows.hpp"
#include "bie/sphere/small_product.hpp"

namespace vehd {

namespace {

/// Part of a table of Fourier sums and the orders that belong to it.
struct FourierTable {
  const RowMatrix& table;
  bool sine;
  int first_order;  ///< sin 0φ takes no part

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

/// Amplitudes of the shape data along the latitudes of a hemisphere, of even and of odd n + m apart: T and mT/sin θ
/// have the parity (−1)^(n+m) about the equator, dT/dθ the opposite one.
void TargetRows::legendre_synthesis(int kind, bool sine) {
  AzimuthalAmplitudes& amplitudes = shape_amplitudes_[static_cast<std::size_t>(kind)];
  const Index columns = rotated_shape_.columns(sine);
  // ∂/∂φ takes cosines to minus sines, sines to cosines; the sign waits for load_nodes.
  const bool into_sine = (kind == 2) != sine;
  for (int m = sine ? 1 : 0; m <= order_; ++m) {
    for (const int parity : {0, 1}) {
      const HalfLegendre table(q_, kind, m, parity);
      const bool are_there = places_.degrees.shape[(m + parity) % 2];
      // Where degrees are odd, of each order there is one parity alone.
      if (inverted_ && !are_there) continue;
      small_product(n_half_, are_there ? table.n_degrees : 0, columns, table.synthesis,
                    rotated_shape_.row(sine, m, m) + parity * columns, 2 * columns,
                    amplitudes.of_order(into_sine, latitude(0, parity), m), amplitudes.latitude_stride(into_sine));
    }
  }
}

void TargetRows::fourier_synthesis(int kind, int i, int parity) {
  AzimuthalAmplitudes& amplitudes = shape_amplitudes_[static_cast<std::size_t>(kind)];
  std::size_t part = 0;
  for (const FourierTable& fourier : fourier_tables(q_)) {
    const Index columns = amplitudes.columns(fourier.sine);
    small_product(n_quarter_, fourier.n_orders(), columns, fourier.synthesis(),
                  amplitudes.of_order(fourier.sine, latitude(i, parity), fourier.first_order), columns,
                  shape_parts_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(parity)][part].data(), columns);
    ++part;
  }
}

/// Shape data at azimuths φ, π − φ, π + φ, −φ; in the mirror at the first two.
template <int kWidth>
void TargetRows::load_nodes(Index quarter_node, Index first, Side side, Nodes<kWidth>& nodes) const {
  for (std::size_t kind = 0; kind < static_cast<std::size_t>(shape_kinds_); ++kind) {
    const auto& parts = shape_parts_[kind];
    const auto part = [&](std::size_t which, std::size_t position) {
      const Index columns = shape_amplitudes_[kind].columns(which >= 2);
      const Index place = quarter_node * columns + static_cast<Index>(position) * chunk_ + first;
      const auto even = Lanes<kWidth>::load(parts[0][which].data() + place);
      if (side == Side::alone) return even;
      const auto odd = Lanes<kWidth>::load(parts[1][which].data() + place);
      return side == Side::north ? even + odd : kind == 1 ? odd - even : even - odd;
    };
    const auto node = [&](std::size_t image, std::size_t component) -> auto& {
      return nodes[image][kind * 3 + component];
    };
    if (!mirrored_) {
      // Where sines count negative, φ and −φ change places.
      const std::array<std::size_t, kMostImages> image = kind == 2 ? std::array<std::size_t, kMostImages>{3, 2, 1, 0}
                                                                   : std::array<std::size_t, kMostImages>{0, 1, 2, 3};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto ce = part(0, c), co = part(1, c), se = part(2, c), so = part(3, c);
        const auto even = ce + co, odd = ce - co, plus = se + so, minus = se - so;
        node(image[0], c) = even + plus;
        node(image[1], c) = odd - minus;
        node(image[2], c) = odd + minus;
        node(image[3], c) = even - plus;
      }
      continue;
    }
    const auto& cosines = components_.of(kind == 2);
    for (std::size_t c = 0; c < cosines.size(); ++c) {
      node(0, static_cast<std::size_t>(cosines[c])) = part(0, c) + part(1, c);
      node(1, static_cast<std::size_t>(cosines[c])) = part(0, c) - part(1, c);
    }
    const double sign = kind == 2 ? -1.0 : 1.0;
    const auto& sines = components_.of(kind != 2);
    for (std::size_t c = 0; c < sines.size(); ++c) {
      node(0, static_cast<std::size_t>(sines[c])) = sign * (part(3, c) + part(2, c));
      node(1, static_cast<std::size_t>(sines[c])) = sign * (part(3, c) - part(2, c));
    }
  }
}

/// The other way for kernel values, those of even n + m from what both hemispheres have in common, of odd from the
/// difference.
template <int kWidth, bool kAlone>
void TargetRows::put_values(Index quarter_node, Index first, const Values<kWidth>& north, const Values<kWidth>& south) {
  for (std::size_t parity = 0; parity < (kAlone ? 1 : 2); ++parity) {
    auto& parts = row_parts_[parity];
    const auto value = [&](std::size_t image, std::size_t kernel) {
      if constexpr (kAlone) return north[image][kernel];
      const auto here = north[image][kernel], there = south[image][kernel];
      return parity == 0 ? here + there : here - there;
    };
    const auto put = [&](std::size_t which, std::size_t position, const auto& lanes) {
      Lanes<kWidth>::store(parts[which].data() + quarter_node * rows_.columns(which >= 2) +
                               static_cast<Index>(position) * chunk_ + first,
                           lanes);
    };
    if (!mirrored_) {
      for (std::size_t c = 0; c < static_cast<std::size_t>(kernels_.count); ++c) {
        const auto v0 = value(0, c), v1 = value(1, c), v2 = value(2, c), v3 = value(3, c);
        const auto right = v0 + v3, left = v1 + v2, up = v0 - v3, down = v1 - v2;
        put(0, c, right + left);
        put(1, c, right - left);
        put(2, c, up - down);
        put(3, c, up + down);
      }
      continue;
    }
    for (const bool sine : {false, true}) {
      const auto& columns = kernel_columns_.of(sine);
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const auto kernel = static_cast<std::size_t>(columns[c]);
        put(sine ? 3 : 0, c, 2.0 * (value(0, kernel) + value(1, kernel)));
        put(sine ? 2 : 1, c, 2.0 * (value(0, kernel) - value(1, kernel)));
      }
    }
  }
}

/// Kernel values at all images of a node.
template <int kWidth>
void TargetRows::evaluate_images(Index quarter_node, Index first, Side side, double weight,
                                 Values<kWidth>& values) const {
  Nodes<kWidth> nodes;
  load_nodes<kWidth>(quarter_node, first, side, nodes);
  for (std::size_t image = 0; image < n_images_; ++image) {
    node_kernels_.evaluate<kWidth>(first, nodes[image], weight, values[image]);
    if (!inverted_) continue;
    // The opposite node lies at −x with −J n, and all harmonics have the opposite value there.
    for (std::size_t i = 0; i < 6; ++i) nodes[image][i] = -nodes[image][i];  // x and ∂x/∂θ
    NodeKernels::Values<kWidth> opposite;
    node_kernels_.evaluate<kWidth>(first, nodes[image], weight, opposite);
    for (std::size_t c = 0; c < static_cast<std::size_t>(kernels_.count); ++c) values[image][c] -= opposite[c];
  }
}

/// A node with all images in both hemispheres, for some targets of the chunk.
template <int kWidth>
void TargetRows::evaluate_node(Index quarter_node, Index first, bool alone, double weight) {
  Values<kWidth> north;
  if (alone) {
    evaluate_images<kWidth>(quarter_node, first, Side::alone, weight, north);
    return put_values<kWidth, true>(quarter_node, first, north, north);
  }
  Values<kWidth> south;
  evaluate_images<kWidth>(quarter_node, first, Side::north, weight, north);
  evaluate_images<kWidth>(quarter_node, first, Side::south, weight, south);
  put_values<kWidth, false>(quarter_node, first, north, south);
}

void TargetRows::evaluate_latitude(int i) {
  const bool equator = 2 * i + 1 == q_.n_theta, alone = inverted_ || equator;
  const int n_parities = alone ? 1 : 2;
  // The equator is its own image.
  if (equator && !inverted_) {
    for (int kind = 0; kind < shape_kinds_; ++kind) {
      shape_amplitudes_[static_cast<std::size_t>(kind)].add_latitude(latitude(i, 1), latitude(i, 0));
    }
  }
  for (int kind = 0; kind < shape_kinds_; ++kind) {
    for (int parity = 0; parity < n_parities; ++parity) fourier_synthesis(kind, i, parity);
  }
  // Nodes on the equator would meet their opposites twice.
  const double weight = inverted_ && equator ? 0.5 * q_.weight[i] : q_.weight[i];
  for (Index quarter_node = 0; quarter_node < n_quarter_; ++quarter_node) {
    // Registers of this processor, and shorter ones for what is left over.
    constexpr auto kWide = static_cast<int>(kTogether);
    Index first = 0;
    for (; first + kWide <= chunk_; first += kWide) evaluate_node<kWide>(quarter_node, first, alone, weight);
    if constexpr (kWide > kLanes) {
      if (first < chunk_) evaluate_node<kLanes>(quarter_node, first, alone, weight);
    }
  }
  for (int parity = 0; parity < n_parities; ++parity) fourier_adjoint(i, parity);
  // Of the odd harmonics the equator knows nothing: what they are multiplied with there is zero.
  if (equator && !inverted_) row_amplitudes_.copy_latitude(latitude(i, 0), latitude(i, 1));
}

void TargetRows::fourier_adjoint(int i, int parity) {
  std::size_t part = 0;
  for (const FourierTable& fourier : fourier_tables(q_)) {
    const Index columns = row_amplitudes_.columns(fourier.sine);
    small_product(fourier.n_orders(), n_quarter_, columns, fourier.adjoint(),
                  row_parts_[static_cast<std::size_t>(parity)][part].data(), columns,
                  row_amplitudes_.of_order(fourier.sine, latitude(i, parity), fourier.first_order), columns);
    ++part;
  }
}

void TargetRows::legendre_adjoint(bool sine) {
  const Index columns = rotated_rows_.columns(sine);
  for (int m = sine ? 1 : 0; m <= order_; ++m) {
    for (const int parity : {0, 1}) {
      if (!places_.degrees.rows[(m + parity) % 2]) continue;
      const HalfLegendre table(q_, 0, m, parity);
      small_product(table.n_degrees, n_half_, columns, table.adjoint(),
                    row_amplitudes_.of_order(sine, latitude(0, parity), m), row_amplitudes_.latitude_stride(sine),
                    rotated_rows_.row(sine, m, m) + parity * columns, 2 * columns);
    }
  }
}

}  // namespace vehd
