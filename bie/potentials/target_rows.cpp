#include "bie/potentials/target_rows.hpp"

#include <algorithm>
#include <cmath>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

using ConstBlock = Eigen::Map<const RowMatrix, 0, Eigen::OuterStride<>>;

/// Calls f(latitude, first, count) for ranges of columns that share a latitude, where every target has `components`
/// columns, component-major.
template <typename Function>
void for_each_latitude(std::span<const Target> targets, int components, const Function& f) {
  const Index n_targets = static_cast<Index>(targets.size());
  if (targets.front().latitude == targets.back().latitude) {
    f(targets.front().latitude, 0, components * n_targets);
    return;
  }
  for (Index first = 0; first < n_targets;) {
    Index end = first;
    while (end < n_targets && targets[end].latitude == targets[first].latitude) ++end;
    for (int i = 0; i < components; ++i) f(targets[first].latitude, i * n_targets + first, end - first);
    first = end;
  }
}

}  // namespace

TargetRows::TargetRows(const RotatedQuadrature& quadrature, const KernelColumns& kernels, const Matrix& position,
                       int azimuthal_order, int chunk)
    : q_(quadrature),
      kernels_(kernels),
      position_(position),
      chunk_(chunk),
      order_(quadrature.order),
      azimuthal_order_(azimuthal_order),
      shape_(order_, 3 * chunk),
      rotated_shape_(order_, 3 * chunk),
      rows_(order_, kernels.count * chunk),
      rotated_rows_(order_, kernels.count * chunk),
      shape_kinds_(kernels.need_source_normal() ? kShapeKinds : 1) {}

void TargetRows::run(std::span<const Target> targets, RowMatrix& rows) {
  load_shape(targets);
  rotate(targets);
  synthesize_shape();
  evaluate_kernels(targets);
  collect_rows();
  rotate_back(targets);
  store_rows(targets, rows);
}

/// Coefficients of x(R_z(φ_t) s): a phase shift for every target of the chunk.
void TargetRows::load_shape(std::span<const Target> targets) {
  for (int m = 0; m <= azimuthal_order_; ++m) {
    for (int t = 0; t < chunk_; ++t) {
      const double c = std::cos(m * targets[t].phi);
      const double s = std::sin(m * targets[t].phi);
      for (int n = m; n <= order_; ++n) {
        for (int i = 0; i < 3; ++i) {
          const double a = position_(coefficient_index(n, m), i);
          const double b = m > 0 ? position_(coefficient_index(n, -m), i) : 0.0;
          shape_.row(false, n, m)[i * chunk_ + t] = a * c + b * s;
          shape_.row(true, n, m)[i * chunk_ + t] = b * c - a * s;
        }
      }
    }
  }
}

void TargetRows::rotate(std::span<const Target> targets) {
  for_each_latitude(targets, 3, [&](int latitude, Index first, Index count) {
    const RotationY& rotation = q_.rotations[latitude];
    for (int n = 0; n <= order_; ++n) {
      const int m = std::min(n, azimuthal_order_);
      rotated_shape_.degree_block(false, n, 0).middleCols(first, count).noalias() =
          rotation.cosine[n].leftCols(m + 1) * shape_.degree_block(false, n, 0).block(0, first, m + 1, count);
      if (m == 0) continue;
      rotated_shape_.degree_block(true, n, 1).middleCols(first, count).noalias() =
          rotation.sine[n].leftCols(m) * shape_.degree_block(true, n, 1).block(0, first, m, count);
    }
  });
}

void TargetRows::rotate_back(std::span<const Target> targets) {
  for_each_latitude(targets, kernels_.count, [&](int latitude, Index first, Index count) {
    const RotationY& rotation = q_.rotations[latitude];
    for (int n = 0; n <= order_; ++n) {
      const int m = std::min(n, azimuthal_order_);
      rows_.degree_block(false, n, 0).block(0, first, m + 1, count).noalias() =
          rotation.cosine[n].leftCols(m + 1).transpose() *
          rotated_rows_.degree_block(false, n, 0).middleCols(first, count);
      if (m == 0) continue;
      rows_.degree_block(true, n, 1).block(0, first, m, count).noalias() =
          rotation.sine[n].leftCols(m).transpose() * rotated_rows_.degree_block(true, n, 1).middleCols(first, count);
    }
  });
}

/// Shape data at all nodes of all targets in the chunk, in nodes_[kind]: [quadrant][quarter φ][θ][3][target].
/// Only the double layers need the tangents.
void TargetRows::synthesize_shape() {
  const Index columns = Index{3} * chunk_;
  const Index plane = q_.n_theta * columns;
  const int n_even = order_ / 2 + 1;
  const int n_odd = (order_ + 1) / 2;
  for (int kind = 0; kind < shape_kinds_; ++kind) {
    even_cosine_[kind].resize(n_even, plane);
    even_sine_[kind].resize(n_even, plane);
    odd_cosine_[kind].resize(n_odd, plane);
    odd_sine_[kind].resize(n_odd, plane);
  }
  for (int m = 0; m <= order_; ++m) {
    product_.noalias() = q_.synthesis[m].topRows(shape_kinds_ * q_.n_theta) * rotated_shape_.order_block(false, m);
    product_sine_.noalias() = q_.synthesis[m].topRows(shape_kinds_ * q_.n_theta) * rotated_shape_.order_block(true, m);
    for (int kind = 0; kind < shape_kinds_; ++kind) {
      const Eigen::Map<const Eigen::RowVectorXd> from_cosine(product_.data() + kind * plane, plane);
      const Eigen::Map<const Eigen::RowVectorXd> from_sine(product_sine_.data() + kind * plane, plane);
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
    out.resize(4 * quarter, plane);
    // φ, π − φ, π + φ, −φ
    out.middleRows(0, quarter) = (ce_ + co_) + (se_ + so_);
    out.middleRows(quarter, quarter) = (ce_ - co_) - (se_ - so_);
    out.middleRows(2 * quarter, quarter) = (ce_ - co_) + (se_ - so_);
    out.middleRows(3 * quarter, quarter) = (ce_ + co_) - (se_ + so_);
  }
}

/// Kernel times weight, in values_: [quadrant][quarter φ][θ][kernel][target].
void TargetRows::evaluate_kernels(std::span<const Target> targets) {
  const int n_targets = chunk_;
  values_.resize(q_.n_phi, q_.n_theta * row_columns());
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
  for (int azimuth = 0; azimuth < q_.n_phi; ++azimuth) {
    for (int i = 0; i < q_.n_theta; ++i) {
      const double* x = nodes_[0].row(azimuth).data() + Index{3} * i * n_targets;
      double* out = values_.row(azimuth).data() + i * row_columns();
      const double laplace_weight = kLaplacePrefactor * q_.weight[i];
#pragma omp simd
      for (int t = 0; t < n_targets; ++t) {
        rx[t] = xt[t] - x[t];
        ry[t] = yt[t] - x[n_targets + t];
        rz[t] = zt[t] - x[2 * n_targets + t];
        inverse_r[t] = 1.0 / std::sqrt(rx[t] * rx[t] + ry[t] * ry[t] + rz[t] * rz[t]);
      }
      if (kernels_.single >= 0) {
        double* single = out + kernels_.single * n_targets;
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) single[t] = laplace_weight * laplace_single_kernel(inverse_r[t]);
      }
      if (kernels_.double_layer >= 0) {
        const double* u = nodes_[1].row(azimuth).data() + Index{3} * i * n_targets;
        const double* v = nodes_[2].row(azimuth).data() + Index{3} * i * n_targets;
        double* double_layer = out + kernels_.double_layer * n_targets;
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) {
          const double ux = u[t], uy = u[n_targets + t], uz = u[2 * n_targets + t];
          const double vx = v[t], vy = v[n_targets + t], vz = v[2 * n_targets + t];
          const double r_dot_area =
              rx[t] * (uy * vz - uz * vy) + ry[t] * (uz * vx - ux * vz) + rz[t] * (ux * vy - uy * vx);
          double_layer[t] = laplace_weight * laplace_double_kernel(r_dot_area, inverse_r[t]);
        }
      }
      if (kernels_.adjoint >= 0) {
        double* adjoint = out + kernels_.adjoint * n_targets;
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) {
          const double r_dot_n = rx[t] * nxt[t] + ry[t] * nyt[t] + rz[t] * nzt[t];
          adjoint[t] = laplace_weight * laplace_adjoint_kernel(r_dot_n, inverse_r[t]);
        }
      }
      if (kernels_.stokes >= 0) {
        double* stokes = out + kernels_.stokes * n_targets;
        const double stokes_weight = stokes_single_layer_prefactor(1.0) * q_.weight[i];
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) {
          const auto g = stokeslet(rx[t], ry[t], rz[t], inverse_r[t]);
          for (int c = 0; c < 6; ++c) stokes[c * n_targets + t] = stokes_weight * g[c];
        }
      }
      if (kernels_.stokes_double >= 0) {
        const double* u = nodes_[1].row(azimuth).data() + Index{3} * i * n_targets;
        const double* v = nodes_[2].row(azimuth).data() + Index{3} * i * n_targets;
        double* stokes = out + kernels_.stokes_double * n_targets;
        const double stokes_weight = kStokesDoubleLayerPrefactor * q_.weight[i];
#pragma omp simd
        for (int t = 0; t < n_targets; ++t) {
          const double ux = u[t], uy = u[n_targets + t], uz = u[2 * n_targets + t];
          const double vx = v[t], vy = v[n_targets + t], vz = v[2 * n_targets + t];
          const double r_dot_area =
              rx[t] * (uy * vz - uz * vy) + ry[t] * (uz * vx - ux * vz) + rz[t] * (ux * vy - uy * vx);
          const auto k = stokes_double_kernel(rx[t], ry[t], rz[t], r_dot_area, inverse_r[t]);
          for (int c = 0; c < 6; ++c) stokes[c * n_targets + t] = stokes_weight * k[c];
        }
      }
    }
  }
}

/// Adjoint of the synthesis: the weighted kernel values become rows over rotated coefficients.
void TargetRows::collect_rows() {
  const int quarter = q_.n_phi / 4;
  const auto k1 = values_.middleRows(0, quarter);
  const auto k2 = values_.middleRows(quarter, quarter);
  const auto k3 = values_.middleRows(2 * quarter, quarter);
  const auto k4 = values_.middleRows(3 * quarter, quarter);
  ce_ = (k1 + k4) + (k2 + k3);
  co_ = (k1 + k4) - (k2 + k3);
  se_ = (k1 - k4) - (k2 - k3);
  so_ = (k1 - k4) + (k2 - k3);
  even_cosine_[0].noalias() = q_.cosine_even.transpose() * ce_;
  odd_cosine_[0].noalias() = q_.cosine_odd.transpose() * co_;
  even_sine_[0].noalias() = q_.sine_even.transpose() * se_;
  odd_sine_[0].noalias() = q_.sine_odd.transpose() * so_;
  const Index columns = row_columns();
  for (int m = 0; m <= order_; ++m) {
    const RowMatrix& cosine = m % 2 == 0 ? even_cosine_[0] : odd_cosine_[0];
    const RowMatrix& sine = m % 2 == 0 ? even_sine_[0] : odd_sine_[0];
    const ConstBlock cosine_m(cosine.row(m / 2).data(), q_.n_theta, columns, Eigen::OuterStride<>(columns));
    const ConstBlock sine_m(sine.row(m / 2).data(), q_.n_theta, columns, Eigen::OuterStride<>(columns));
    rotated_rows_.order_block(false, m).noalias() = q_.adjoint[m] * cosine_m;
    rotated_rows_.order_block(true, m).noalias() = q_.adjoint[m] * sine_m;
  }
}

/// Undoes the phase shift.
void TargetRows::store_rows(std::span<const Target> targets, RowMatrix& rows) const {
  const Index n_kernels = kernels_.count;
  const Index block = rows.cols() / n_kernels;
  const Index stride = row_columns();
  Index offset = 0;
  for (int m = 0; m <= azimuthal_order_; ++m) {
    const Index n_degrees = order_ + 1 - m;
    for (int t = 0; t < chunk_; ++t) {
      const double cosine_phase = std::cos(m * targets[t].phi);
      const double sine_phase = std::sin(m * targets[t].phi);
      double* row = rows.row(targets[t].row).data() + offset;
      for (Index c = 0; c < n_kernels; ++c, row += block) {
        const double* cosine = rows_.row(false, m, m) + c * chunk_ + t;
        const double* sine = rows_.row(true, m, m) + c * chunk_ + t;
        for (Index i = 0; i < n_degrees; ++i) {
          row[i] = cosine[i * stride] * cosine_phase - sine[i * stride] * sine_phase;
        }
        if (m == 0) continue;
        for (Index i = 0; i < n_degrees; ++i) {
          row[n_degrees + i] = cosine[i * stride] * sine_phase + sine[i * stride] * cosine_phase;
        }
      }
    }
    offset += (m == 0 ? 1 : 2) * n_degrees;
  }
}

}  // namespace vehd
