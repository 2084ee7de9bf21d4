#pragma once

#include "bie/potentials/layer_sums.hpp"
#include "bie/potentials/side.hpp"
#include "bie/potentials/smooth_grid.hpp"

namespace vehd {

/// Sums times 1/(4π), 1/(8π) for the Stokes single layer at μ = 1 and 3/(4π) for the Stokes double layer.
/// Source: paper Eqs. (6), (9)
LayersAt with_prefactors(LayersAt sums);

/// D[1]: −1 inside, 0 outside, −½ on the membrane.
/// Source: Gauss's theorem
double enclosure_of(Side side);

/// One size per layer: of a change, or of what a change is small against.
using LayerSizes = std::array<double, LayersAt::count>;

/// Absolute change of every layer from one evaluation to another.
LayerSizes change(const LayersAt& a, const LayersAt& b);

/// Largest densities on the membrane: times √(area/4π) for the single layers, ∇_γ f for ∇D.
/// What a change of the layers is small against: units of each layer.
LayerSizes density_sizes(const SmoothGrid& grid, const NodeColumns& columns);

/// Whether every change is below the tolerance times its size.
bool is_small(const LayerSizes& change, const LayerSizes& sizes, double tolerance);

}  // namespace vehd
