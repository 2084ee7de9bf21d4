#include "bie/potentials/target_rows.hpp"

#include <algorithm>
#include <cmath>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

using ConstBlock = Eigen::Map<const RowMatrix, 0, Eigen::OuterStride<>>;

/// One rotation serves all of them, in matrix products.
bool share_latitude(std::span<const Target> targets) { return targets.front().latitude == targets.back().latitude; }

Index size_of(const std::vector<int>& columns, int chunk) { return static_cast<Index>(columns.size()) * chunk; }

CoefficientBlock block_for(int order, int highest, const FourierColumns& columns, int chunk) {
  return {order, highest, size_of(columns.cosine, chunk), size_of(columns.sine, chunk)};
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

TargetRows::TargetRows(const RotatedQuadrature& quadrature, const KernelColumns& kernels, const Matrix& position,
                       int azimuthal_order, int chunk, bool mirrored)
    : q_(quadrature),
      kernels_(kernels),
      position_(position),
      chunk_(chunk),
      order_(quadrature.order),
      azimuthal_order_(azimuthal_order),
      mirrored_(mirrored),
      n_azimuths_(mirrored ? quadrature.n_phi / 2 : quadrature.n_phi),
      components_(shape_columns(mirrored)),
      kernel_columns_(row_columns(kernels, mirrored)),
      shape_(block_for(order_, azimuthal_order, components_, chunk)),
      rotated_shape_(block_for(order_, order_, components_, chunk)),
      rows_(block_for(order_, azimuthal_order, kernel_columns_, chunk)),
      rotated_rows_(block_for(order_, order_, kernel_columns_, chunk)),
      shape_kinds_(kernels.need_source_normal() ? kShapeKinds : 1),
      kernel_places_(places_of(kernel_columns_.cosine, kernel_columns_.sine)),
      rotation_entries_(chunk) {
  component_places_[0] = component_places_[1] = places_of(components_.cosine, components_.sine);
  // ∂/∂φ exchanges cosines and sines.
  component_places_[2] = places_of(components_.sine, components_.cosine);
}

std::vector<ColumnPlace> TargetRows::places_of(const std::vector<int>& first, const std::vector<int>& second) const {
  std::vector<ColumnPlace> places(first.size() + (mirrored_ ? second.size() : 0));
  for (std::size_t i = 0; i < first.size(); ++i) {
    places[first[i]] = {static_cast<Index>(i) * chunk_, size_of(first, chunk_)};
  }
  if (!mirrored_) return places;
  const Index offset = q_.n_theta * size_of(first, chunk_);
  for (std::size_t i = 0; i < second.size(); ++i) {
    places[second[i]] = {offset + static_cast<Index>(i) * chunk_, size_of(second, chunk_)};
  }
  return places;
}

void TargetRows::run(std::span<const Target> targets, RowMatrix& rows) {
  phase_shift(targets);
  rotate(targets);
  synthesize_shape();
  evaluate_kernels(targets);
  adjoint_synthesis();
  rotate_back(targets);
  store_rows(targets, rows);
}

/// Coefficients of x(R_z(φ_t) s): a phase shift for every target of the chunk.
void TargetRows::phase_shift(std::span<const Target> targets) {
  for (int m = 0; m <= azimuthal_order_; ++m) {
    for (int t = 0; t < chunk_; ++t) {
      const double c = std::cos(m * targets[t].phi);
      const double s = std::sin(m * targets[t].phi);
      for (int n = m; n <= order_; ++n) {
        const auto a = [&](int component) { return position_(coefficient_index(n, m), component); };
        const auto b = [&](int component) { return m > 0 ? position_(coefficient_index(n, -m), component) : 0.0; };
        double* cosine = shape_.row(false, n, m) + t;
        for (const int i : components_.cosine) {
          *cosine = a(i) * c + b(i) * s;
          cosine += chunk_;
        }
        double* sine = shape_.row(true, n, m) + t;
        for (const int i : components_.sine) {
          *sine = b(i) * c - a(i) * s;
          sine += chunk_;
        }
      }
    }
  }
}

void TargetRows::load_rotation_entries(std::span<const Target> targets, bool sine, int n, int after, int before) {
  const int first = sine ? 1 : 0;
  for (int t = 0; t < chunk_; ++t) {
    const RotationY& rotation = q_.rotations[targets[t].latitude];
    rotation_entries_[t] = (sine ? rotation.sine : rotation.cosine)[n](after - first, before - first);
  }
}

void TargetRows::add_rotated(double* to, const double* from, Index columns) const {
  for (Index i = 0; i < columns; i += chunk_, to += chunk_, from += chunk_) {
#pragma omp simd
    for (int t = 0; t < chunk_; ++t) to[t] += rotation_entries_[t] * from[t];
  }
}

void TargetRows::rotate_one_by_one(std::span<const Target> targets, int n, const Orders& from, const Orders& to,
                                   bool back) {
  for (const bool sine : {false, true}) {
    const Index columns = from.block.columns(sine);
    for (int i = sine; i <= to.highest; ++i) {
      double* sum = to.block.row(sine, n, i);
      std::fill_n(sum, columns, 0.0);
      for (int k = sine; k <= from.highest; ++k) {
        load_rotation_entries(targets, sine, n, back ? k : i, back ? i : k);
        add_rotated(sum, from.block.row(sine, n, k), columns);
      }
    }
  }
}

void TargetRows::rotate(std::span<const Target> targets) {
  const RotationY& rotation = q_.rotations[targets.front().latitude];
  for (int n = 0; n <= order_; ++n) {
    const int m = std::min(n, azimuthal_order_);
    if (share_latitude(targets)) {
      rotated_shape_.degree_block(false, n, 0, n).noalias() =
          rotation.cosine[n].leftCols(m + 1) * shape_.degree_block(false, n, 0, m);
      if (m == 0) continue;
      rotated_shape_.degree_block(true, n, 1, n).noalias() =
          rotation.sine[n].leftCols(m) * shape_.degree_block(true, n, 1, m);
      continue;
    }
    rotate_one_by_one(targets, n, {shape_, m}, {rotated_shape_, n}, false);
  }
}

void TargetRows::rotate_back(std::span<const Target> targets) {
  const RotationY& rotation = q_.rotations[targets.front().latitude];
  for (int n = 0; n <= order_; ++n) {
    const int m = std::min(n, azimuthal_order_);
    if (share_latitude(targets)) {
      rows_.degree_block(false, n, 0, m).noalias() =
          rotation.cosine[n].leftCols(m + 1).transpose() * rotated_rows_.degree_block(false, n, 0, n);
      if (m == 0) continue;
      rows_.degree_block(true, n, 1, m).noalias() =
          rotation.sine[n].leftCols(m).transpose() * rotated_rows_.degree_block(true, n, 1, n);
      continue;
    }
    rotate_one_by_one(targets, n, {rotated_rows_, n}, {rows_, m}, true);
  }
}

/// Shape data at all nodes of all targets in the chunk, in nodes_[kind]: [quadrant][quarter φ], along an azimuth as
/// component_places_ says. Only the double layers need the tangents.
void TargetRows::synthesize_shape() {
  const Index plane = q_.n_theta * rotated_shape_.columns(false);
  const Index plane_sine = q_.n_theta * rotated_shape_.columns(true);
  const int n_even = order_ / 2 + 1;
  const int n_odd = (order_ + 1) / 2;
  for (int kind = 0; kind < shape_kinds_; ++kind) {
    const bool exchanged = kind == 2;
    even_cosine_[kind].resize(n_even, exchanged ? plane_sine : plane);
    even_sine_[kind].resize(n_even, exchanged ? plane : plane_sine);
    odd_cosine_[kind].resize(n_odd, exchanged ? plane_sine : plane);
    odd_sine_[kind].resize(n_odd, exchanged ? plane : plane_sine);
  }
  for (int m = 0; m <= order_; ++m) {
    product_.noalias() = q_.synthesis[m].topRows(shape_kinds_ * q_.n_theta) * rotated_shape_.order_block(false, m);
    product_sine_.noalias() = q_.synthesis[m].topRows(shape_kinds_ * q_.n_theta) * rotated_shape_.order_block(true, m);
    for (int kind = 0; kind < shape_kinds_; ++kind) {
      const Eigen::Map<const Eigen::RowVectorXd> from_cosine(product_.data() + kind * plane, plane);
      const Eigen::Map<const Eigen::RowVectorXd> from_sine(product_sine_.data() + kind * plane_sine, plane_sine);
      RowMatrix& cosine = m % 2 == 0 ? even_cosine_[kind] : odd_cosine_[kind];
      RowMatrix& sine = m % 2 == 0 ? even_sine_[kind] : odd_sine_[kind];
      if (kind == 2) {
        cosine.row(m / 2) = from_sine;
        sine.row(m / 2) = -from_cosine;
      } else {
        cosine.row(m / 2) = from_cosine;
        sine.row(m / 2) = from_sine;
      }
    }
  }
  const int quarter = q_.n_phi / 4;
  for (int kind = 0; kind < shape_kinds_; ++kind) {
    ce_.noalias() = q_.cosine_even * even_cosine_[kind];
    se_.noalias() = q_.sine_even * even_sine_[kind];
    co_.noalias() = q_.cosine_odd * odd_cosine_[kind];
    so_.noalias() = q_.sine_odd * odd_sine_[kind];
    RowMatrix& out = nodes_[kind];
    if (mirrored_) {
      // φ, π − φ
      out.resize(2 * quarter, plane + plane_sine);
      out.topLeftCorner(quarter, ce_.cols()) = ce_ + co_;
      out.bottomLeftCorner(quarter, ce_.cols()) = ce_ - co_;
      out.topRightCorner(quarter, se_.cols()) = so_ + se_;
      out.bottomRightCorner(quarter, se_.cols()) = so_ - se_;
      continue;
    }
    out.resize(4 * quarter, plane);
    // φ, π − φ, π + φ, −φ
    out.middleRows(0, quarter) = (ce_ + co_) + (se_ + so_);
    out.middleRows(quarter, quarter) = (ce_ - co_) - (se_ - so_);
    out.middleRows(2 * quarter, quarter) = (ce_ - co_) + (se_ - so_);
    out.middleRows(3 * quarter, quarter) = (ce_ + co_) - (se_ + so_);
  }
}

/// Kernel times weight, in values_: [quadrant][quarter φ], along an azimuth as kernel_places_ says.
void TargetRows::evaluate_kernels(std::span<const Target> targets) {
  const int n_targets = chunk_;
  const Index width = rotated_rows_.columns(false) + (mirrored_ ? rotated_rows_.columns(true) : 0);
  values_.resize(n_azimuths_, q_.n_theta * width);
  const auto component = [&](int kind, int azimuth, int i, int c) {
    const ColumnPlace& place = component_places_[kind][c];
    return nodes_[kind].row(azimuth).data() + place.start + i * place.stride;
  };
  // Columns: position and area vector of the targets.
  Matrix at(n_targets, 6);
  for (int t = 0; t < n_targets; ++t) at.row(t) << targets[t].position.transpose(), targets[t].area_vector.transpose();
  const double* xt = at.col(0).data();
  const double* yt = at.col(1).data();
  const double* zt = at.col(2).data();
  const double* nxt = at.col(3).data();
  const double* nyt = at.col(4).data();
  const double* nzt = at.col(5).data();
  distance_.resize(n_targets, 4);
  double* rx = distance_.col(0).data();
  double* ry = distance_.col(1).data();
  double* rz = distance_.col(2).data();
  double* inverse_r = distance_.col(3).data();
  for (int azimuth = 0; azimuth < n_azimuths_; ++azimuth) {
    for (int i = 0; i < q_.n_theta; ++i) {
      const double* x = component(0, azimuth, i, 0);
      const double* y = component(0, azimuth, i, 1);
      const double* z = component(0, azimuth, i, 2);
      const auto out = [&](int kernel) {
        const ColumnPlace& place = kernel_places_[kernel];
        return values_.row(azimuth).data() + place.start + i * place.stride;
      };
      const double laplace_weight = kLaplacePrefactor * q_.weight[i];
#pragma omp simd
      for (int t = 0; t < n_targets; ++t) {
        rx[t] = xt[t] - x[t];
        ry[t] = yt[t] - y[t];
        rz[t] = zt[t] - z[t];
        inverse_r[t] = 1.0 / std::sqrt(rx[t] * rx[t] + ry[t] * ry[t] + rz[t] * rz[t]);
      }
      if (kernels_.single >= 0) {
        double* single = out(kernels_.single);
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) single[t] = laplace_weight * laplace_single_kernel(inverse_r[t]);
      }
      if (kernels_.double_layer >= 0) {
        std::array<const double*, 3> u, v;
        for (int c = 0; c < 3; ++c) {
          u[c] = component(1, azimuth, i, c);
          v[c] = component(2, azimuth, i, c);
        }
        double* double_layer = out(kernels_.double_layer);
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) {
          const double ux = u[0][t], uy = u[1][t], uz = u[2][t];
          const double vx = v[0][t], vy = v[1][t], vz = v[2][t];
          const double r_dot_area =
              rx[t] * (uy * vz - uz * vy) + ry[t] * (uz * vx - ux * vz) + rz[t] * (ux * vy - uy * vx);
          double_layer[t] = laplace_weight * laplace_double_kernel(r_dot_area, inverse_r[t]);
        }
      }
      if (kernels_.adjoint >= 0) {
        double* adjoint = out(kernels_.adjoint);
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) {
          const double r_dot_n = rx[t] * nxt[t] + ry[t] * nyt[t] + rz[t] * nzt[t];
          adjoint[t] = laplace_weight * laplace_adjoint_kernel(r_dot_n, inverse_r[t]);
        }
      }
      if (kernels_.stokes >= 0) {
        std::array<double*, 6> stokes;
        for (int c = 0; c < 6; ++c) stokes[c] = out(kernels_.stokes + c);
        const double stokes_weight = stokes_single_layer_prefactor(1.0) * q_.weight[i];
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) {
          const auto g = stokeslet(rx[t], ry[t], rz[t], inverse_r[t]);
          for (int c = 0; c < 6; ++c) stokes[c][t] = stokes_weight * g[c];
        }
      }
      if (kernels_.stokes_double >= 0) {
        std::array<const double*, 3> u, v;
        for (int c = 0; c < 3; ++c) {
          u[c] = component(1, azimuth, i, c);
          v[c] = component(2, azimuth, i, c);
        }
        std::array<double*, 6> stokes;
        for (int c = 0; c < 6; ++c) stokes[c] = out(kernels_.stokes_double + c);
        const double stokes_weight = kStokesDoubleLayerPrefactor * q_.weight[i];
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) {
          const double ux = u[0][t], uy = u[1][t], uz = u[2][t];
          const double vx = v[0][t], vy = v[1][t], vz = v[2][t];
          const double r_dot_area =
              rx[t] * (uy * vz - uz * vy) + ry[t] * (uz * vx - ux * vz) + rz[t] * (ux * vy - uy * vx);
          const auto k = stokes_double_kernel(rx[t], ry[t], rz[t], r_dot_area, inverse_r[t]);
          for (int c = 0; c < 6; ++c) stokes[c][t] = stokes_weight * k[c];
        }
      }
    }
  }
}

/// Adjoint of the synthesis: the weighted kernel values become rows over rotated coefficients.
void TargetRows::adjoint_synthesis() {
  const int quarter = q_.n_phi / 4;
  const auto k1 = values_.middleRows(0, quarter);
  const auto k2 = values_.middleRows(quarter, quarter);
  if (mirrored_) {
    const Index plane = q_.n_theta * rotated_rows_.columns(false);
    const Index plane_sine = q_.n_theta * rotated_rows_.columns(true);
    ce_ = 2.0 * (k1.leftCols(plane) + k2.leftCols(plane));
    co_ = 2.0 * (k1.leftCols(plane) - k2.leftCols(plane));
    se_ = 2.0 * (k1.rightCols(plane_sine) - k2.rightCols(plane_sine));
    so_ = 2.0 * (k1.rightCols(plane_sine) + k2.rightCols(plane_sine));
  } else {
    const auto k3 = values_.middleRows(2 * quarter, quarter);
    const auto k4 = values_.middleRows(3 * quarter, quarter);
    ce_ = (k1 + k4) + (k2 + k3);
    co_ = (k1 + k4) - (k2 + k3);
    se_ = (k1 - k4) - (k2 - k3);
    so_ = (k1 - k4) + (k2 - k3);
  }
  even_cosine_[0].noalias() = q_.cosine_even.transpose() * ce_;
  odd_cosine_[0].noalias() = q_.cosine_odd.transpose() * co_;
  even_sine_[0].noalias() = q_.sine_even.transpose() * se_;
  odd_sine_[0].noalias() = q_.sine_odd.transpose() * so_;
  const auto legendre_sum = [&](bool sine, int m, const RowMatrix& sums) {
    const Index columns = rotated_rows_.columns(sine);
    const ConstBlock of_order(sums.row(m / 2).data(), q_.n_theta, columns, Eigen::OuterStride<>(columns));
    rotated_rows_.order_block(sine, m).noalias() = q_.adjoint[m] * of_order;
  };
  for (int m = 0; m <= order_; ++m) {
    legendre_sum(false, m, m % 2 == 0 ? even_cosine_[0] : odd_cosine_[0]);
    legendre_sum(true, m, m % 2 == 0 ? even_sine_[0] : odd_sine_[0]);
  }
}

/// Undoes the phase shift.
void TargetRows::store_rows(std::span<const Target> targets, RowMatrix& rows) const {
  const Index block = rows.cols() / kernels_.count;
  // Both parts of a target's row start from zero, and each has what its columns are.
  for (int t = 0; t < chunk_; ++t) rows.row(targets[t].row).setZero();
  for (const bool sine : {false, true}) {
    const std::vector<int>& columns = kernel_columns_.of(sine);
    const Index stride = rows_.columns(sine);
    Index offset = 0;
    for (int m = 0; m <= azimuthal_order_; ++m) {
      const Index n_degrees = order_ + 1 - m;
      for (int t = 0; t < chunk_; ++t) {
        const double cosine_phase = std::cos(m * targets[t].phi);
        const double sine_phase = std::sin(m * targets[t].phi);
        const double to_cosine = sine ? -sine_phase : cosine_phase;
        const double to_sine = sine ? cosine_phase : sine_phase;
        for (std::size_t c = 0; c < columns.size(); ++c) {
          double* row = rows.row(targets[t].row).data() + columns[c] * block + offset;
          const double* from = rows_.row(sine, m, m) + static_cast<Index>(c) * chunk_ + t;
          for (Index i = 0; i < n_degrees; ++i) row[i] += from[i * stride] * to_cosine;
          if (m == 0) continue;
          for (Index i = 0; i < n_degrees; ++i) row[n_degrees + i] += from[i * stride] * to_sine;
        }
      }
      offset += (m == 0 ? 1 : 2) * n_degrees;
    }
  }
}

}  // namespace vehd
