#include "bie/potentials/target_values.hpp"

#include <algorithm>
#include <cmath>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"

namespace vehd {

LayersAt with_prefactors(LayersAt sums) {
  for (std::size_t layer = 0; layer < LayersAt::count; ++layer) {
    sums.of[layer] *= layer == LayersAt::stokes          ? stokes_single_layer_prefactor(1.0)
                      : layer == LayersAt::stokes_double ? kStokesDoubleLayerPrefactor
                                                         : kLaplacePrefactor;
  }
  sums.enclosure *= kLaplacePrefactor;
  return sums;
}

double enclosure_of(Side side) {
  switch (side) {
    case Side::interior:
      return -1.0;
    case Side::exterior:
      return 0.0;
    case Side::principal_value:
      break;
  }
  return -0.5;
}

LayerSizes change(const LayersAt& a, const LayersAt& b) {
  LayerSizes sizes{};
  for (std::size_t layer = 0; layer < sizes.size(); ++layer) sizes[layer] = (a.of[layer] - b.of[layer]).norm();
  return sizes;
}

LayerSizes density_sizes(const SmoothGrid& grid, const NodeColumns& columns) {
  const double radius = mean_radius(grid);
  const Vector area = grid.area_vectors.rowwise().norm();
  LayerSizes sizes{};
  if (columns.single >= 0) {
    sizes[LayersAt::single_gradient] = grid.nodes.col(columns.single).cwiseQuotient(area).cwiseAbs().maxCoeff();
    sizes[LayersAt::single] = radius * sizes[LayersAt::single_gradient];
  }
  if (columns.double_layer >= 0)
    sizes[LayersAt::double_layer] = grid.nodes.col(columns.double_layer).cwiseAbs().maxCoeff();
  if (columns.double_1 >= 0) {
    for (Index i = 0; i < area.size(); ++i) {
      const auto node = grid.nodes.row(i);
      const Vector3 rotated_gradient = (node[columns.double_1] * node.segment<3>(columns.tangent_2) -
                                        node[columns.double_2] * node.segment<3>(columns.tangent_1))
                                           .transpose();
      sizes[LayersAt::double_gradient] = std::max(sizes[LayersAt::double_gradient], rotated_gradient.norm() / area[i]);
    }
  }
  if (columns.stokes >= 0) {
    const Vector weighted = grid.nodes.middleCols(columns.stokes, 3).rowwise().norm();
    sizes[LayersAt::stokes] = radius * weighted.cwiseQuotient(area).maxCoeff();
  }
  if (columns.stokes_double >= 0) {
    sizes[LayersAt::stokes_double] = grid.nodes.middleCols(columns.stokes_double, 3).rowwise().norm().maxCoeff();
  }
  return sizes;
}

bool is_small(const LayerSizes& change, const LayerSizes& sizes, double tolerance) {
  return std::ranges::equal(change, sizes, [=](double moved, double size) { return moved <= tolerance * size; });
}

}  // namespace vehd
