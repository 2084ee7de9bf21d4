#include "bie/potentials/target_values.hpp"

#include <algorithm>
#include <cmath>

#include "bie/kernels/laplace.hpp"
#include "bie/kernels/stokes.hpp"

namespace vehd {

TargetValues with_prefactors(const LayerSums& sums) {
  TargetValues v;
  v.single = kLaplacePrefactor * sums.single;
  v.single_gradient = kLaplacePrefactor * sums.single_gradient;
  v.double_layer = kLaplacePrefactor * sums.double_layer;
  v.double_gradient = kLaplacePrefactor * sums.double_gradient;
  v.stokes = stokes_single_layer_prefactor(1.0) * sums.stokes;
  v.stokes_double = kStokesDoubleLayerPrefactor * sums.stokes_double;
  v.enclosure = kLaplacePrefactor * sums.solid_angle;
  return v;
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

LayerSizes change(const TargetValues& a, const TargetValues& b) {
  return {std::abs(a.single - b.single),
          std::abs(a.double_layer - b.double_layer),
          (a.single_gradient - b.single_gradient).norm(),
          (a.double_gradient - b.double_gradient).norm(),
          (a.stokes - b.stokes).norm(),
          (a.stokes_double - b.stokes_double).norm()};
}

LayerSizes density_sizes(const SmoothGrid& grid, const NodeColumns& columns) {
  const double radius = mean_radius(grid);
  const Vector area = grid.area_vectors.rowwise().norm();
  LayerSizes sizes;
  if (columns.single >= 0) {
    sizes.single_gradient = grid.nodes.col(columns.single).cwiseQuotient(area).cwiseAbs().maxCoeff();
    sizes.single = radius * sizes.single_gradient;
  }
  if (columns.double_layer >= 0) sizes.double_layer = grid.nodes.col(columns.double_layer).cwiseAbs().maxCoeff();
  if (columns.double_1 >= 0) {
    for (Index i = 0; i < area.size(); ++i) {
      const auto node = grid.nodes.row(i);
      const Vector3 rotated_gradient = (node[columns.double_1] * node.segment<3>(columns.tangent_2) -
                                        node[columns.double_2] * node.segment<3>(columns.tangent_1))
                                           .transpose();
      sizes.double_gradient = std::max(sizes.double_gradient, rotated_gradient.norm() / area[i]);
    }
  }
  if (columns.stokes >= 0) {
    const Vector weighted = grid.nodes.middleCols(columns.stokes, 3).rowwise().norm();
    sizes.stokes = radius * weighted.cwiseQuotient(area).maxCoeff();
  }
  if (columns.stokes_double >= 0) {
    sizes.stokes_double = grid.nodes.middleCols(columns.stokes_double, 3).rowwise().norm().maxCoeff();
  }
  return sizes;
}

bool is_small(const LayerSizes& change, const LayerSizes& sizes, double tolerance) {
  return change.single <= tolerance * sizes.single && change.double_layer <= tolerance * sizes.double_layer &&
         change.single_gradient <= tolerance * sizes.single_gradient &&
         change.double_gradient <= tolerance * sizes.double_gradient && change.stokes <= tolerance * sizes.stokes &&
         change.stokes_double <= tolerance * sizes.stokes_double;
}

}  // namespace vehd
