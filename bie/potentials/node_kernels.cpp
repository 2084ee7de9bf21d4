#include "bie/potentials/node_kernels.hpp"

#include "bie/kernels/inverse_roots.hpp"
#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/sphere/small_product.hpp"

namespace vehd {

NodeKernels::NodeKernels(const KernelColumns& kernels, int chunk)
    : kernels_(kernels), chunk_(chunk), targets_(static_cast<std::size_t>(6 * chunk)) {}

void NodeKernels::set_targets(std::span<const Target> targets) {
  for (int t = 0; t < chunk_; ++t) {
    for (int i = 0; i < 3; ++i) {
      targets_[i * chunk_ + t] = targets[t].position[i];
      targets_[(i + 3) * chunk_ + t] = targets[t].area_vector[i];
    }
  }
}

void NodeKernels::evaluate(const double* node, double weight, double* values) const {
  constexpr int kWide = 2 * kLanes;
  int first = 0;
  for (; first + kWide <= chunk_; first += kWide) evaluate_lanes<kWide>(first, node, weight, values);
  if (first < chunk_) evaluate_lanes<kLanes>(first, node, weight, values);
}

template <int kWidth>
void NodeKernels::evaluate_lanes(int first, const double* node, double weight, double* values) const {
  const double laplace_weight = kLaplacePrefactor * weight;
  const double stokes_weight = stokes_single_layer_prefactor(1.0) * weight;
  const double stokes_double_weight = kStokesDoubleLayerPrefactor * weight;
  const double* y = node + first;
  const double* x = targets_.data() + first;
  double* out = values + first;
  const Index chunk = chunk_;
  std::array<double, kWidth> rx, ry, rz, inverse_r, r_dot_area;
#pragma omp simd
  for (int t = 0; t < kWidth; ++t) {
    rx[t] = x[t] - y[t];
    ry[t] = x[chunk + t] - y[chunk + t];
    rz[t] = x[2 * chunk + t] - y[2 * chunk + t];
    inverse_r[t] = rx[t] * rx[t] + ry[t] * ry[t] + rz[t] * rz[t];
  }
  invert_roots(inverse_r);
  if (kernels_.need_source_normal()) {
    const double* u = y + 3 * chunk;
    const double* v = y + 6 * chunk;
#pragma omp simd
    for (int t = 0; t < kWidth; ++t) {
      const double ux = u[t], uy = u[chunk + t], uz = u[2 * chunk + t];
      const double vx = v[t], vy = v[chunk + t], vz = v[2 * chunk + t];
      r_dot_area[t] = rx[t] * (uy * vz - uz * vy) + ry[t] * (uz * vx - ux * vz) + rz[t] * (ux * vy - uy * vx);
    }
  }
  if (kernels_.single >= 0) {
    double* single = out + kernels_.single * chunk;
#pragma omp simd
    for (int t = 0; t < kWidth; ++t) single[t] = laplace_weight * laplace_single_kernel(inverse_r[t]);
  }
  if (kernels_.double_layer >= 0) {
    double* double_layer = out + kernels_.double_layer * chunk;
#pragma omp simd
    for (int t = 0; t < kWidth; ++t) {
      double_layer[t] = laplace_weight * laplace_double_kernel(r_dot_area[t], inverse_r[t]);
    }
  }
  if (kernels_.adjoint >= 0) {
    double* adjoint = out + kernels_.adjoint * chunk;
    const double* n = x + 3 * chunk;
#pragma omp simd
    for (int t = 0; t < kWidth; ++t) {
      const double r_dot_n = rx[t] * n[t] + ry[t] * n[chunk + t] + rz[t] * n[2 * chunk + t];
      adjoint[t] = laplace_weight * laplace_adjoint_kernel(r_dot_n, inverse_r[t]);
    }
  }
  if (kernels_.stokes >= 0) {
    double* stokes = out + kernels_.stokes * chunk;
#pragma omp simd
    for (int t = 0; t < kWidth; ++t) {
      const auto g = stokeslet(rx[t], ry[t], rz[t], inverse_r[t]);
      for (int c = 0; c < 6; ++c) stokes[c * chunk + t] = stokes_weight * g[c];
    }
  }
  if (kernels_.stokes_double >= 0) {
    double* stokes = out + kernels_.stokes_double * chunk;
#pragma omp simd
    for (int t = 0; t < kWidth; ++t) {
      const auto k = stokes_double_kernel(rx[t], ry[t], rz[t], r_dot_area[t], inverse_r[t]);
      for (int c = 0; c < 6; ++c) stokes[c * chunk + t] = stokes_double_weight * k[c];
    }
  }
}

}  // namespace vehd
