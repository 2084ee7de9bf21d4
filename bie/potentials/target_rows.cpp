#include "bie/potentials/target_rows.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/small_product.hpp"

namespace vehd {

namespace {

/// Whether one rotation applies to all targets, in matrix products.
bool share_latitude(std::span<const Target> targets) { return targets.front().latitude == targets.back().latitude; }

Index size_of(const std::vector<int>& columns, Index chunk) { return static_cast<Index>(columns.size()) * chunk; }

CoefficientBlock block_for(int order, int highest, const FourierColumns& columns, Index chunk) {
  return {order, highest, size_of(columns.cosine, chunk), size_of(columns.sine, chunk)};
}

using LanesOfRows = Lanes<kLanes>::Values;

void transpose(std::array<LanesOfRows, kLanes>& v) {
  static_assert(kLanes == 4);
  const LanesOfRows low_01 = __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6);
  const LanesOfRows high_01 = __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7);
  const LanesOfRows low_23 = __builtin_shufflevector(v[2], v[3], 0, 4, 2, 6);
  const LanesOfRows high_23 = __builtin_shufflevector(v[2], v[3], 1, 5, 3, 7);
  v = {__builtin_shufflevector(low_01, low_23, 0, 1, 4, 5), __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5),
       __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7), __builtin_shufflevector(high_01, high_23, 2, 3, 6, 7)};
}

/// Position of a column in a list, −1 if absent.
Index place_of(const std::vector<int>& columns, int column) {
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found == columns.end() ? -1 : found - columns.begin();
}

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

TargetRows::TargetRows(const TargetContext& context, const RowPlaces& places, int chunk)
    : q_(context.quadrature),
      kernels_(context.kernels),
      position_(context.position),
      places_(places),
      chunk_(chunk),
      order_(q_.order),
      azimuthal_order_(context.azimuthal_order),
      mirrored_(context.mirrored),
      inverted_(!places.degrees.shape[0] && !places.degrees.rows[0]),
      n_latitudes_(inverted_ ? (q_.n_theta + 1) / 2 : q_.n_theta),
      n_images_(mirrored_ ? 2 : 4),
      shape_kinds_(kernels_.need_source_normal() ? kShapeKinds : 1),
      n_quarter_(q_.n_phi / 4),
      components_(shape_columns(mirrored_)),
      kernel_columns_(row_columns(kernels_, mirrored_)),
      shape_(block_for(order_, azimuthal_order_, components_, chunk)),
      rotated_shape_(block_for(order_, order_, components_, chunk)),
      rows_(block_for(order_, azimuthal_order_, kernel_columns_, chunk)),
      rotated_rows_(block_for(order_, order_, kernel_columns_, chunk)),
      node_kernels_(kernels_, chunk),
      row_amplitudes_(n_latitudes_, order_, rows_.columns(false), rows_.columns(true)),
      cosines_(context.phi.size(), azimuthal_order_ + 1),
      sines_(cosines_.rows(), cosines_.cols()),
      cosine_phases_(static_cast<std::size_t>((azimuthal_order_ + 1) * chunk)),
      sine_phases_(cosine_phases_.size()),
      rotation_entries_(static_cast<std::size_t>(chunk)),
      zeros_(static_cast<std::size_t>(chunk), 0.0),
      phases_back_(4 * cosine_phases_.size()) {
  Index widest = std::max(rows_.columns(false), rows_.columns(true));
  for (int kind = 0; kind < shape_kinds_; ++kind) {
    // ∂/∂φ exchanges cosines and sines.
    const Index cosines = shape_.columns(kind == 2), sines = shape_.columns(kind != 2);
    widest = std::max({widest, cosines, sines});
    shape_amplitudes_.emplace_back(n_latitudes_, order_, cosines, sines);
    for (int part = 0; part < kParts; ++part)
      shape_parts_[kind][part].resize(n_quarter_ * (part < 2 ? cosines : sines));
  }
  for (int part = 0; part < kParts; ++part) row_parts_[part].resize(n_quarter_ * rows_.columns(part >= 2));
  for (Index k = 0; k < cosines_.rows(); ++k) {
    for (int m = 0; m <= azimuthal_order_; ++m) {
      cosines_(k, m) = std::cos(m * context.phi[k]);
      sines_(k, m) = std::sin(m * context.phi[k]);
    }
  }
  for (auto& half : half_) half.resize((q_.n_theta + 1) / 2 * widest);
  list_stored_entries();
}

void TargetRows::list_stored_entries() {
  constexpr StoredEntry kNone{-1, -1, -1};
  std::vector<StoredEntry> of_column;
  Index i = 0;
  for (int kernel = 0; kernel < kernels_.count; ++kernel) {
    const std::array<Index, 2> places{place_of(kernel_columns_.cosine, kernel), place_of(kernel_columns_.sine, kernel)};
    const auto offset = [&](bool sine, int n, int m) {
      if (places[sine] < 0) return std::int32_t{-1};
      return static_cast<std::int32_t>(rows_.row(sine, n, m) - rows_.row(sine, 0, 0) + places[sine] * chunk_);
    };
    for (int m = 0; m <= azimuthal_order_; ++m) {
      for (const bool sine : {false, true}) {
        for (int n = m; n <= order_ && (m > 0 || !sine); ++n, ++i) {
          const Index column = places_.columns.empty() ? i : places_.columns[i];
          if (column < 0) continue;
          if (column >= std::ssize(of_column)) of_column.resize(static_cast<std::size_t>(column + 1), kNone);
          of_column[static_cast<std::size_t>(column)] = {offset(false, n, m), offset(true, n, m), 2 * m + sine};
        }
      }
    }
  }
  bool joins = false;
  for (Index column = 0; column < std::ssize(of_column); ++column) {
    const StoredEntry& entry = of_column[static_cast<std::size_t>(column)];
    const bool is_there = entry.phases >= 0;
    if (is_there) {
      if (!joins || stored_.back().count == kLanes) stored_.push_back({column, 0, {}});
      stored_.back().entries[static_cast<std::size_t>(stored_.back().count++)] = entry;
    }
    joins = is_there;
  }
}

void TargetRows::run(std::span<const Target> targets, RowMatrix& rows) {
  load_phases(targets);
  node_kernels_.set_targets(targets);
  phase_shift();
  rotate(targets);
  for (int kind = 0; kind < shape_kinds_; ++kind) {
    for (const bool sine : {false, true}) legendre_synthesis(kind, sine);
  }
  for (int i = 0; i < n_latitudes_; ++i) evaluate_latitude(i);
  for (const bool sine : {false, true}) legendre_adjoint(sine);
  if (kernels_.hypersingular >= 0) subtract_pole();
  rotate_back(targets);
  store_rows(targets, rows);
}

void TargetRows::load_phases(std::span<const Target> targets) {
  for (int m = 0; m <= azimuthal_order_; ++m) {
    double* back = phases_back_.data() + 4 * m * chunk_;
    for (Index t = 0; t < chunk_; ++t) {
      const double c = cosines_(targets[t].longitude, m), s = sines_(targets[t].longitude, m);
      cosine_phases_[m * chunk_ + t] = back[t] = back[3 * chunk_ + t] = c;
      sine_phases_[m * chunk_ + t] = back[2 * chunk_ + t] = s;
      back[chunk_ + t] = -s;
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
          for (Index t = 0; t < chunk_; t += kLanes) {
            Lanes<kLanes>::store(to + t, of_cosine * Lanes<kLanes>::load(c + t) + of_sine * Lanes<kLanes>::load(s + t));
          }
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
    if (!places_.degrees.shape[n % 2]) continue;
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
    if (!places_.degrees.rows[n % 2]) continue;
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

/// Undoes the phase shift, and transposes targets side by side to rows.
void TargetRows::store_rows(std::span<const Target> targets, RowMatrix& rows) {
  std::vector<double*> row_of;
  for (const Target& target : targets) row_of.push_back(rows.row(target.row).data());
  const double* cosines = rows_.row(false, 0, 0);
  const double* sines = rows_.row(true, 0, 0);
  const auto unphase = [&](const StoredEntry& entry, Index first, LanesOfRows& values) {
    const double* factors = phases_back_.data() + 2 * entry.phases * chunk_ + first;
    const double* cosine = entry.cosine < 0 ? zeros_.data() : cosines + entry.cosine + first;
    const double* sine = entry.sine < 0 ? zeros_.data() : sines + entry.sine + first;
    values = Lanes<kLanes>::load(cosine) * Lanes<kLanes>::load(factors) +
             Lanes<kLanes>::load(sine) * Lanes<kLanes>::load(factors + chunk_);
  };
  for (const StoredEntries& together : stored_) {
    const auto& entries = together.entries;
    for (Index first = 0; first < chunk_; first += kLanes) {
      double* const* to = row_of.data() + first;
      if (together.count < kLanes) {
        for (int i = 0; i < together.count; ++i) {
          LanesOfRows values;
          unphase(entries[static_cast<std::size_t>(i)], first, values);
          for (int t = 0; t < kLanes; ++t) to[t][together.column + i] = values[t];
        }
        continue;
      }
      std::array<LanesOfRows, kLanes> values;
      for (std::size_t i = 0; i < kLanes; ++i) unphase(entries[i], first, values[i]);
      transpose(values);
      for (std::size_t t = 0; t < kLanes; ++t) Lanes<kLanes>::store(to[t] + together.column, values[t]);
    }
  }
}

}  // namespace vehd
