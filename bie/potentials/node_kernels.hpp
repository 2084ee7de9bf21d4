#pragma once

#include <array>
#include <span>
#include <vector>

#include "bie/potentials/kernel_columns.hpp"

namespace vehd {

/// A node of the target grid.
struct Target {
  int latitude = 0;
  int longitude = 0;
  Vector3 position;
  Vector3 area_vector;  ///< J n
  Index row = 0;        ///< where its kernel rows go
};

/// Values of the selected kernels between the targets of a chunk and one node about each of them.
class NodeKernels {
 public:
  /// @param kernels  must outlive this
  /// @param chunk    targets at a time, a multiple of kLanes
  NodeKernels(const KernelColumns& kernels, int chunk);

  /// The targets that follow; as many as the chunk.
  void set_targets(std::span<const Target> targets);
  /// @param node    what is synthesised there, [9 x chunk]: x and its derivatives by θ and by φ over sin θ in the frame
  ///     of each target, the latter only where need_source_normal()
  /// @param weight  of the quadrature
  /// @param values  kernels times weight, [kernels x chunk]
  void evaluate(const double* node, double weight, double* values) const;

 private:
  /// The same for targets from that one on.
  template <int kWidth>
  void evaluate_lanes(int first, const double* node, double weight, double* values) const;

  const KernelColumns& kernels_;
  int chunk_;
  std::vector<double> targets_;  ///< [6 x chunk], position and area vector
};

}  // namespace vehd
