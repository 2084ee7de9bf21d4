#include "bie/potentials/node_kernels.hpp"

namespace vehd {

NodeKernels::NodeKernels(const KernelColumns& kernels, int chunk)
    : kernels_(kernels), chunk_(chunk), targets_(static_cast<std::size_t>(6 * chunk)) {}

void NodeKernels::set_targets(std::span<const Target> targets) {
  for (Index t = 0; t < chunk_; ++t) {
    const Target& target = targets[static_cast<std::size_t>(t)];
    for (Index i = 0; i < 3; ++i) {
      targets_[static_cast<std::size_t>(i * chunk_ + t)] = target.position[i];
      targets_[static_cast<std::size_t>((i + 3) * chunk_ + t)] = target.area_vector[i];
    }
  }
}

}  // namespace vehd
