#include "bie/potentials/operator_blocks.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

#include "bie/kernels/stokes.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

using Sets = std::pair<std::vector<Index>, std::vector<Index>>;

/// Collects destinations into one block per pair of coefficient sets.
class GrowingBlocks {
 public:
  void add(const std::vector<Index>& in, const std::vector<Index>& out, const OperatorBlock::Destination& destination) {
    if (in.empty() || out.empty()) return;
    OperatorBlock& block = of_sets_[{in, out}];
    block.in = in;
    block.out = out;
    block.destinations.push_back(destination);
    auto& kernels = block.kernels;
    if (std::find(kernels.begin(), kernels.end(), destination.kernel) == kernels.end()) {
      kernels.push_back(destination.kernel);
    }
  }
  [[nodiscard]] std::vector<OperatorBlock> side_by_side() {
    std::vector<OperatorBlock> result;
    Index column = 0;
    for (auto& [sets, block] : of_sets_) {
      block.first_column = column;
      column += block.width();
      result.push_back(std::move(block));
    }
    return result;
  }

 private:
  std::map<Sets, OperatorBlock> of_sets_;
};

}  // namespace

int order_of_index(Index index) { return static_cast<int>(index - coefficient_index(degree_of(index), 0)); }

DegreeParities degree_parities(const KernelColumns& kernels, const SymmetrySubspace& subspace, bool turned) {
  DegreeParities result;
  const std::vector<Reflection>& all = subspace.symmetry().reflections;
  if (std::find(all.begin(), all.end(), Reflection{-1, -1, -1}) == all.end()) return result;
  result.shape[0] = false;
  const bool laplace =
      kernels.single >= 0 || kernels.double_layer >= 0 || kernels.adjoint >= 0 || kernels.hypersingular >= 0;
  result.rows[0] = laplace || turned;
  return result;
}

SymmetricLayout symmetric_layout(const KernelColumns& kernels, const SymmetrySubspace& subspace, int azimuthal_order) {
  SymmetricLayout layout;
  layout.entries = subspace.vectors();
  layout.first_matrix.resize(static_cast<std::size_t>(kernels.count));
  GrowingBlocks blocks;
  const Index n_all = subspace.n_coefficients();
  std::vector<Index> of_component[3];
  for (const Index entry : layout.entries) of_component[entry / n_all].push_back(entry % n_all);
  for (const int first_kernel : {kernels.stokes, kernels.stokes_double}) {
    if (first_kernel < 0) continue;
    layout.first_matrix[first_kernel] = layout.sizes.size();
    Index first_in = 0;
    for (int in = 0; in < 3; ++in) {
      Index first_out = 0;
      for (int out = 0; out < 3; ++out) {
        blocks.add(of_component[in], of_component[out],
                   {first_kernel + kStokesBlock[out][in], layout.sizes.size(), first_in, first_out});
        first_out += static_cast<Index>(of_component[out].size());
      }
      first_in += static_cast<Index>(of_component[in].size());
    }
    layout.sizes.push_back(static_cast<Index>(layout.entries.size()));
  }
  for (const std::vector<Index>& all_of_class : subspace.scalar_classes()) {
    std::vector<Index> of_class;
    for (const Index i : all_of_class) {
      if (std::abs(order_of_index(i)) <= azimuthal_order) of_class.push_back(i);
    }
    if (!of_class.empty()) layout.classes.push_back(std::move(of_class));
  }
  for (const int kernel : {kernels.single, kernels.double_layer, kernels.adjoint, kernels.hypersingular}) {
    if (kernel < 0) continue;
    layout.first_matrix[kernel] = layout.sizes.size();
    for (const std::vector<Index>& of_class : layout.classes) {
      blocks.add(of_class, of_class, {kernel, layout.sizes.size(), 0, 0});
      layout.sizes.push_back(static_cast<Index>(of_class.size()));
    }
  }
  layout.blocks = blocks.side_by_side();
  return layout;
}

}  // namespace vehd
