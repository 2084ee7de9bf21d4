#include "bie/potentials/node_kernels.hpp"

#include <array>
#include <bit>
#include <cstring>

#include "bie/kernels/inverse_roots.hpp"
#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/sphere/small_product.hpp"

namespace vehd {

namespace {

/// A register of the compiler's own kind: what arrays hold goes through memory between one loop and the next.
template <int kWidth>
struct TargetLanes {
  using Values [[gnu::vector_size(kWidth * sizeof(double))]] = double;
};

}  // namespace

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
  using Lanes = typename TargetLanes<kWidth>::Values;
  const Index chunk = chunk_;
  const auto load = [](const double* at) {
    Lanes lanes;
    std::memcpy(&lanes, at, sizeof lanes);
    return lanes;
  };
  const auto source = [&](int i) { return load(node + first + i * chunk); };
  const auto target = [&](int i) { return load(targets_.data() + first + i * chunk); };
  const auto put = [&](int kernel, const Lanes& lanes) {
    std::memcpy(values + first + kernel * chunk, &lanes, sizeof lanes);
  };
  const Lanes rx = target(0) - source(0), ry = target(1) - source(1), rz = target(2) - source(2);
  auto roots = std::bit_cast<std::array<double, kWidth>>(Lanes(rx * rx + ry * ry + rz * rz));
  invert_roots(roots);
  const auto inverse_r = std::bit_cast<Lanes>(roots);
  Lanes r_dot_area{};
  if (kernels_.need_source_normal()) {
    const Lanes ux = source(3), uy = source(4), uz = source(5), vx = source(6), vy = source(7), vz = source(8);
    r_dot_area = rx * (uy * vz - uz * vy) + ry * (uz * vx - ux * vz) + rz * (ux * vy - uy * vx);
  }
  const double laplace_weight = kLaplacePrefactor * weight;
  if (kernels_.single >= 0) put(kernels_.single, laplace_weight * laplace_single_kernel(inverse_r));
  if (kernels_.double_layer >= 0) {
    put(kernels_.double_layer, laplace_weight * laplace_double_kernel(r_dot_area, inverse_r));
  }
  if (kernels_.adjoint >= 0) {
    const Lanes r_dot_n = rx * target(3) + ry * target(4) + rz * target(5);
    put(kernels_.adjoint, laplace_weight * laplace_adjoint_kernel(r_dot_n, inverse_r));
  }
  const auto put_blocks = [&](int first_kernel, double block_weight, const std::array<Lanes, 6>& blocks) {
    for (int block = 0; block < 6; ++block) put(first_kernel + block, block_weight * blocks[block]);
  };
  if (kernels_.stokes >= 0) {
    put_blocks(kernels_.stokes, stokes_single_layer_prefactor(1.0) * weight, stokeslet(rx, ry, rz, inverse_r));
  }
  if (kernels_.stokes_double >= 0) {
    put_blocks(kernels_.stokes_double, kStokesDoubleLayerPrefactor * weight,
               stokes_double_kernel(rx, ry, rz, r_dot_area, inverse_r));
  }
}

}  // namespace vehd
