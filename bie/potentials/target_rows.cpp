#include "bie/potentials/target_rows.hpp"

#include <algorithm>
#include <cmath>

#include "bie/potentials/small_product.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// One rotation serves all of them, in matrix products.
bool share_latitude(std::span<const Target> targets) { return targets.front().latitude == targets.back().latitude; }

Index size_of(const std::vector<int>& columns, Index chunk) { return static_cast<Index>(columns.size()) * chunk; }

CoefficientBlock block_for(int order, int highest, const FourierColumns& columns, Index chunk) {
  return {order, highest, size_of(columns.cosine, chunk), size_of(columns.sine, chunk)};
}

/// Where a column stands in a list, −1 if it does not.
Index place_of(const std::vector<int>& columns, int column) {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found == columns.end() ? -1 : found - columns.begin();
}

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

FourierColumns shape_columns(bool mirrored) {
  if (mirrored) return {{0, 2}, {1}};
  return {{0, 1, 2}, {0, 1, 2}};
}

FourierColumns row_columns(const KernelColumns& kernels, bool mirrored) {
  FourierColumns result;
  for (int c = 0; c < kernels.count; ++c) {
    const int block = kernels.stokes_block(c);
    const bool odd = block == 1 || block == 4;  // xy and yz
    if (!mirrored || !odd) result.cosine.push_back(c);
    if (!mirrored || odd) result.sine.push_back(c);
  }
  return result;
}

TargetRows::TargetRows(const RotatedQuadrature& quadrature, const KernelColumns& kernels, const Matrix& position,
                       int azimuthal_order, int chunk, bool mirrored)
    : q_(quadrature),
      kernels_(kernels),
      position_(position),
      chunk_(chunk),
      order_(quadrature.order),
      azimuthal_order_(azimuthal_order),
      mirrored_(mirrored),
      n_images_(mirrored ? 2 : 4),
      shape_kinds_(kernels.need_source_normal() ? kShapeKinds : 1),
      n_quarter_(quadrature.n_phi / 4),
      components_(shape_columns(mirrored)),
      kernel_columns_(row_columns(kernels, mirrored)),
      shape_(block_for(order_, azimuthal_order, components_, chunk)),
      rotated_shape_(block_for(order_, order_, components_, chunk)),
      rows_(block_for(order_, azimuthal_order, kernel_columns_, chunk)),
      rotated_rows_(block_for(order_, order_, kernel_columns_, chunk)),
      node_kernels_(kernels, chunk),
      row_amplitudes_(quadrature.n_theta, order_, rows_.columns(false), rows_.columns(true)),
      nodes_(static_cast<std::size_t>(n_images_ * kShapeKinds * 3 * chunk)),
      values_(static_cast<std::size_t>(n_images_ * kernels.count * chunk)),
      cosine_phases_(static_cast<std::size_t>((azimuthal_order + 1) * chunk)),
      sine_phases_(cosine_phases_.size()),
      rotation_entries_(static_cast<std::size_t>(chunk)),
      nothing_(static_cast<std::size_t>(chunk), 0.0),
      unphased_(static_cast<std::size_t>(2 * (order_ + 1) * chunk)) {
  Index widest = std::max(rows_.columns(false), rows_.columns(true));
  for (int kind = 0; kind < shape_kinds_; ++kind) {
    // ∂/∂φ exchanges cosines and sines.
    const Index cosines = shape_.columns(kind == 2), sines = shape_.columns(kind != 2);
    widest = std::max({widest, cosines, sines});
    shape_amplitudes_.emplace_back(q_.n_theta, order_, cosines, sines);
    for (int part = 0; part < kParts; ++part) shape_parts_[kind][part].resize(n_quarter_ * (part < 2 ? cosines : sines));
  }
  for (int part = 0; part < kParts; ++part) row_parts_[part].resize(n_quarter_ * rows_.columns(part >= 2));
  for (auto& half : half_) half.resize((q_.n_theta + 1) / 2 * widest);
}

void TargetRows::run(std::span<const Target> targets, RowMatrix& rows) {
  load_phases(targets);
  node_kernels_.set_targets(targets);
  phase_shift();
  rotate(targets);
  for (int kind = 0; kind < shape_kinds_; ++kind) {
    for (const bool sine : {false, true}) legendre_synthesis(kind, sine);
  }
  for (int i = 0; i < q_.n_theta; ++i) evaluate_latitude(i);
  for (const bool sine : {false, true}) legendre_adjoint(sine);
  rotate_back(targets);
  store_rows(targets, rows);
}

void TargetRows::load_phases(std::span<const Target> targets) {
  for (int m = 0; m <= azimuthal_order_; ++m) {
    for (Index t = 0; t < chunk_; ++t) {
      cosine_phases_[m * chunk_ + t] = std::cos(m * targets[t].phi);
      sine_phases_[m * chunk_ + t] = std::sin(m * targets[t].phi);
    }
  }
}

/// Coefficients of x(R_z(φ_t) s): a phase shift for every target of the chunk.
void TargetRows::phase_shift() {
  for (int m = 0; m <= azimuthal_order_; ++m) {
    const double* c = cosine_phases_.data() + m * chunk_;
    const double* s = sine_phases_.data() + m * chunk_;
    for (const bool sine : {false, true}) {
      for (int n = m; n <= order_; ++n) {
        double* to = shape_.row(sine, n, m);
        for (const int i : components_.of(sine)) {
          const double a = position_(coefficient_index(n, m), i);
          const double b = m > 0 ? position_(coefficient_index(n, -m), i) : 0.0;
          const double of_cosine = sine ? b : a, of_sine = sine ? -a : b;
#pragma omp simd
          for (Index t = 0; t < chunk_; ++t) to[t] = of_cosine * c[t] + of_sine * s[t];
          to += chunk_;
        }
      }
    }
  }
}

void TargetRows::rotate_one_by_one(std::span<const Target> targets, int n, const Orders& from, const Orders& to,
                                   bool back) {
  for (const bool sine : {false, true}) {
    const Index columns = from.block.columns(sine);
    const int first = sine ? 1 : 0;
    for (int i = first; i <= to.highest; ++i) {
      double* sum = to.block.row(sine, n, i);
      std::fill_n(sum, columns, 0.0);
      for (int k = first; k <= from.highest; ++k) {
        for (Index t = 0; t < chunk_; ++t) {
          const RotationY& rotation = q_.rotations[targets[t].latitude];
          rotation_entries_[t] =
              (sine ? rotation.sine : rotation.cosine)[n]((back ? k : i) - first, (back ? i : k) - first);
        }
        const double* of_order = from.block.row(sine, n, k);
        for (Index column = 0; column < columns; column += chunk_) {
#pragma omp simd
          for (Index t = 0; t < chunk_; ++t) sum[column + t] += rotation_entries_[t] * of_order[column + t];
        }
      }
    }
  }
}

void TargetRows::rotate(std::span<const Target> targets) {
  const RotationY& rotation = q_.rotations[targets.front().latitude];
  for (int n = 0; n <= order_; ++n) {
    const int highest = std::min(n, azimuthal_order_);
    if (!share_latitude(targets)) {
      rotate_one_by_one(targets, n, {shape_, highest}, {rotated_shape_, n}, false);
      continue;
    }
    for (const bool sine : {false, true}) {
      const int first = sine ? 1 : 0;
      if (highest < first) continue;
      const Matrix& wigner = (sine ? rotation.sine : rotation.cosine)[n];
      small_product(wigner.rows(), highest + 1 - first, shape_.columns(sine), {wigner.data(), 1, wigner.rows()},
                    shape_.row(sine, n, first), shape_.order_stride(sine), rotated_shape_.row(sine, n, first),
                    rotated_shape_.order_stride(sine));
    }
  }
}

void TargetRows::rotate_back(std::span<const Target> targets) {
  const RotationY& rotation = q_.rotations[targets.front().latitude];
  for (int n = 0; n <= order_; ++n) {
    const int highest = std::min(n, azimuthal_order_);
    if (!share_latitude(targets)) {
      rotate_one_by_one(targets, n, {rotated_rows_, n}, {rows_, highest}, true);
      continue;
    }
    for (const bool sine : {false, true}) {
      const int first = sine ? 1 : 0;
      if (highest < first) continue;
      const Matrix& wigner = (sine ? rotation.sine : rotation.cosine)[n];
      small_product(highest + 1 - first, wigner.rows(), rows_.columns(sine), {wigner.data(), wigner.rows(), 1},
                    rotated_rows_.row(sine, n, first), rotated_rows_.order_stride(sine), rows_.row(sine, n, first),
                    rows_.order_stride(sine));
    }
  }
}

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
      small_product(n_half, table.n_degrees, columns, table.synthesis, rotated_shape_.row(sine, m, m) + parity * columns,
                    2 * columns, half_[parity].data(), columns);
    }
    for (Index i = 0; i < n_half; ++i) {
      const double* even = half_[0].data() + i * columns;
      const double* odd = half_[1].data() + i * columns;
      const int mirror_image = q_.n_theta - 1 - static_cast<int>(i);
      double* to_north = shape_amplitudes_[kind].of_order(into_sine, static_cast<int>(i), m);
      double* to_south = shape_amplitudes_[kind].of_order(into_sine, mirror_image, m);
      if (mirror_image > i) {
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

/// Shape data at azimuths φ, π − φ, π + φ, −φ; in the mirror at the first two.
void TargetRows::load_nodes(Index quarter_node) {
  for (int kind = 0; kind < shape_kinds_; ++kind) {
    const auto& cosines = components_.of(kind == 2);
    const auto& sines = components_.of(kind != 2);
    const auto part = [&](int which, std::size_t position) {
      const Index columns = shape_amplitudes_[kind].columns(which >= 2);
      return shape_parts_[kind][which].data() + quarter_node * columns + static_cast<Index>(position) * chunk_;
    };
    const auto node = [&](int image, int component) {
      return nodes_.data() + ((image * kShapeKinds + kind) * 3 + component) * chunk_;
    };
    if (!mirrored_) {
      for (int component = 0; component < 3; ++component) {
        const auto c = static_cast<std::size_t>(component);
        const double *ce = part(0, c), *co = part(1, c), *se = part(2, c), *so = part(3, c);
        double *first = node(0, component), *second = node(1, component);
        double *third = node(2, component), *fourth = node(3, component);
#pragma omp simd
        for (Index t = 0; t < chunk_; ++t) {
          const double even = ce[t] + co[t], odd = ce[t] - co[t], plus = se[t] + so[t], minus = se[t] - so[t];
          first[t] = even + plus;
          second[t] = odd - minus;
          third[t] = odd + minus;
          fourth[t] = even - plus;
        }
      }
      continue;
    }
    for (std::size_t c = 0; c < cosines.size(); ++c) {
      for (Index t = 0; t < chunk_; ++t) {
        node(0, cosines[c])[t] = part(0, c)[t] + part(1, c)[t];
        node(1, cosines[c])[t] = part(0, c)[t] - part(1, c)[t];
      }
    }
    for (std::size_t c = 0; c < sines.size(); ++c) {
      for (Index t = 0; t < chunk_; ++t) {
        node(0, sines[c])[t] = part(3, c)[t] + part(2, c)[t];
        node(1, sines[c])[t] = part(3, c)[t] - part(2, c)[t];
      }
    }
  }
}

/// The other way for kernel values.
void TargetRows::add_values(Index quarter_node) {
  const auto part = [&](int which, std::size_t position) {
    return row_parts_[which].data() + quarter_node * rows_.columns(which >= 2) + static_cast<Index>(position) * chunk_;
  };
  const auto value = [&](int image, int kernel) { return values_.data() + (image * kernels_.count + kernel) * chunk_; };
  if (!mirrored_) {
    for (int kernel = 0; kernel < kernels_.count; ++kernel) {
      const auto c = static_cast<std::size_t>(kernel);
      const double *k1 = value(0, kernel), *k2 = value(1, kernel), *k3 = value(2, kernel), *k4 = value(3, kernel);
      double *ce = part(0, c), *co = part(1, c), *se = part(2, c), *so = part(3, c);
#pragma omp simd
      for (Index t = 0; t < chunk_; ++t) {
        const double right = k1[t] + k4[t], left = k2[t] + k3[t], up = k1[t] - k4[t], down = k2[t] - k3[t];
        ce[t] = right + left;
        co[t] = right - left;
        se[t] = up - down;
        so[t] = up + down;
      }
    }
    return;
  }
  for (const bool sine : {false, true}) {
    const auto& columns = kernel_columns_.of(sine);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double *k1 = value(0, columns[c]), *k2 = value(1, columns[c]);
      double *sum = part(sine ? 3 : 0, c), *difference = part(sine ? 2 : 1, c);
      for (Index t = 0; t < chunk_; ++t) {
        sum[t] = 2.0 * (k1[t] + k2[t]);
        difference[t] = 2.0 * (k1[t] - k2[t]);
      }
    }
  }
}

void TargetRows::evaluate_latitude(int i) {
  for (int kind = 0; kind < shape_kinds_; ++kind) fourier_synthesis(kind, i);
  for (Index quarter_node = 0; quarter_node < n_quarter_; ++quarter_node) {
    load_nodes(quarter_node);
    for (int image = 0; image < n_images_; ++image) {
      node_kernels_.evaluate(nodes_.data() + image * kShapeKinds * 3 * chunk_, q_.weight[i],
                             values_.data() + image * kernels_.count * chunk_);
    }
    add_values(quarter_node);
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

void TargetRows::legendre_adjoint(bool sine) {
  const Index columns = rotated_rows_.columns(sine);
  const Index n_half = (q_.n_theta + 1) / 2;
  for (int m = sine ? 1 : 0; m <= order_; ++m) {
    for (Index i = 0; i < n_half; ++i) {
      double* even = half_[0].data() + i * columns;
      double* odd = half_[1].data() + i * columns;
      const int mirror_image = q_.n_theta - 1 - static_cast<int>(i);
      const double* north = row_amplitudes_.of_order(sine, static_cast<int>(i), m);
      const double* south = row_amplitudes_.of_order(sine, mirror_image, m);
      // The equator is its own image; of the odd harmonics it knows nothing.
      const double share = mirror_image > i ? 1.0 : 0.0;
#pragma omp simd
      for (Index c = 0; c < columns; ++c) {
        even[c] = north[c] + share * south[c];
        odd[c] = north[c] - share * south[c];
      }
    }
    for (const int parity : {0, 1}) {
      const HalfLegendre table(q_, 0, m, parity);
      small_product(table.n_degrees, n_half, columns, table.adjoint(), half_[parity].data(), columns,
                    rotated_rows_.row(sine, m, m) + parity * columns, 2 * columns);
    }
  }
}

/// Undoes the phase shift.
void TargetRows::store_rows(std::span<const Target> targets, RowMatrix& rows) {
  const Index n_active = (order_ + 1) * (order_ + 1) - (order_ - azimuthal_order_) * (order_ - azimuthal_order_ + 1);
  for (int kernel = 0; kernel < kernels_.count; ++kernel) {
    const Index cosine_place = place_of(kernel_columns_.cosine, kernel);
    const Index sine_place = place_of(kernel_columns_.sine, kernel);
    Index offset = kernel * n_active;
    for (int m = 0; m <= azimuthal_order_; ++m) {
      const Index n_degrees = order_ + 1 - m;
      const double* c = cosine_phases_.data() + m * chunk_;
      const double* s = sine_phases_.data() + m * chunk_;
      for (Index i = 0; i < n_degrees; ++i) {
        const int n = m + static_cast<int>(i);
        const double* cosine = cosine_place < 0 ? nothing_.data() : rows_.row(false, n, m) + cosine_place * chunk_;
        const double* sine = sine_place < 0 ? nothing_.data() : rows_.row(true, n, m) + sine_place * chunk_;
        double* of_cosine = unphased_.data() + i * chunk_;
        double* of_sine = unphased_.data() + (n_degrees + i) * chunk_;
#pragma omp simd
        for (Index t = 0; t < chunk_; ++t) {
          of_cosine[t] = cosine[t] * c[t] - sine[t] * s[t];
          of_sine[t] = cosine[t] * s[t] + sine[t] * c[t];
        }
      }
      const Index n_stored = (m == 0 ? 1 : 2) * n_degrees;
      for (Index t = 0; t < chunk_; ++t) {
        double* row = rows.row(targets[t].row).data() + offset;
        for (Index i = 0; i < n_stored; ++i) row[i] = unphased_[i * chunk_ + t];
      }
      offset += n_stored;
    }
  }
}

}  // namespace vehd
