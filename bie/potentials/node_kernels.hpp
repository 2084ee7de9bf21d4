#pragma once

#include <array>
#include <bit>
#include <span>
#include <vector>

#include "bie/kernels/inverse_roots.hpp"
#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/potentials/kernel_columns.hpp"
#include "bie/support/lanes.hpp"

namespace vehd {

/// A node of the target grid.
struct Target {
  int latitude = 0;
  int longitude = 0;
  Vector3 position;
  Vector3 area_vector;  ///< J n, or n where kernels are plain
  Index row = 0;        ///< row of its kernel values in the result
};

/// Values of the selected kernels between the targets of a chunk and one node in the frame of each.
class NodeKernels {
 public:
  static constexpr int kMostKernels = 16;
  /// x, ∂x/∂θ and ∂x/(sin θ ∂φ) in the frame of each target; the derivatives only if need_source_normal().
  template <int kWidth>
  using Node = std::array<typename Lanes<kWidth>::Values, 9>;
  /// Kernels times weight.
  template <int kWidth>
  using Values = std::array<typename Lanes<kWidth>::Values, kMostKernels>;

  /// @param kernels  must outlive this
  /// @param chunk    targets at a time, a multiple of kLanes
  NodeKernels(const KernelColumns& kernels, int chunk)
      : kernels_(kernels), chunk_(chunk), targets_(static_cast<std::size_t>(6 * chunk)) {}

  /// Sets the next targets, as many as the chunk.
  void set_targets(std::span<const Target> targets) {
    for (Index t = 0; t < chunk_; ++t) {
      const Target& target = targets[static_cast<std::size_t>(t)];
      for (Index i = 0; i < 3; ++i) {
        targets_[static_cast<std::size_t>(i * chunk_ + t)] = target.position[i];
        targets_[static_cast<std::size_t>((i + 3) * chunk_ + t)] = target.area_vector[i];
      }
    }
  }
  /// @param first   index of the target in the first lane
  /// @param weight  of the quadrature
  template <int kWidth>
  void evaluate(Index first, const Node<kWidth>& node, double weight, Values<kWidth>& values) const {
    using Lane = typename Lanes<kWidth>::Values;  // of targets side by side
    const auto target = [&](int i) { return Lanes<kWidth>::load(targets_.data() + first + i * chunk_); };
    const auto put = [&](int kernel, const Lane& lanes) { values[static_cast<std::size_t>(kernel)] = lanes; };
    const Lane rx = target(0) - node[0], ry = target(1) - node[1], rz = target(2) - node[2];
    auto roots = std::bit_cast<std::array<double, kWidth>>(Lane(rx * rx + ry * ry + rz * rz));
    invert_roots(roots);
    const auto inverse_r = std::bit_cast<Lane>(roots);
    Lane ax{}, ay{}, az{}, r_dot_area{};
    if (kernels_.need_source_normal()) {
      const auto& [x, y, z, ux, uy, uz, vx, vy, vz] = node;
      ax = uy * vz - uz * vy;
      ay = uz * vx - ux * vz;
      az = ux * vy - uy * vx;
      r_dot_area = rx * ax + ry * ay + rz * az;
    }
    const double laplace_weight = kLaplacePrefactor * weight;
    if (kernels_.single >= 0) put(kernels_.single, laplace_weight * laplace_single_kernel(inverse_r));
    if (kernels_.double_layer >= 0) {
      put(kernels_.double_layer, laplace_weight * laplace_double_kernel(r_dot_area, inverse_r));
    }
    if (kernels_.adjoint >= 0) {
      const Lane r_dot_n = rx * target(3) + ry * target(4) + rz * target(5);
      put(kernels_.adjoint, laplace_weight * laplace_adjoint_kernel(r_dot_n, inverse_r));
    }
    if (kernels_.hypersingular >= 0) {
      const Lane r_dot_n = rx * target(3) + ry * target(4) + rz * target(5);
      const Lane normals = ax * target(3) + ay * target(4) + az * target(5);
      put(kernels_.hypersingular,
          laplace_weight * laplace_hypersingular_kernel(normals, r_dot_n, r_dot_area, inverse_r));
    }
    const auto put_blocks = [&](int first_kernel, double block_weight, const std::array<Lane, 6>& blocks) {
      for (int block = 0; block < 6; ++block) put(first_kernel + block, block_weight * blocks[block]);
    };
    if (kernels_.stokes >= 0) {
      put_blocks(kernels_.stokes, stokes_single_layer_prefactor(1.0) * weight, stokeslet(rx, ry, rz, inverse_r));
    }
    if (kernels_.stokes_double >= 0) {
      put_blocks(kernels_.stokes_double, kStokesDoubleLayerPrefactor * weight,
                 stokes_double_kernel(rx, ry, rz, r_dot_area, inverse_r));
    }
    if (kernels_.plain) {
      auto inverse_areas = std::bit_cast<std::array<double, kWidth>>(Lane(ax * ax + ay * ay + az * az));
      invert_roots(inverse_areas);
      const Lane area = 1.0 / std::bit_cast<Lane>(inverse_areas);
      const auto weigh = [&](int first_kernel, int count) {
        for (int i = 0; i < count; ++i) values[static_cast<std::size_t>(first_kernel + i)] *= area;
      };
      if (kernels_.single >= 0) weigh(kernels_.single, 1);
      if (kernels_.adjoint >= 0) weigh(kernels_.adjoint, 1);
      if (kernels_.stokes >= 0) weigh(kernels_.stokes, 6);
    }
  }

 private:
  const KernelColumns& kernels_;
  Index chunk_;
  std::vector<double> targets_;  ///< [6 x chunk], position and area vector or normal
};

}  // namespace vehd
