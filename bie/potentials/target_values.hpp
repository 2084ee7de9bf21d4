#pragma once

#include "bie/potentials/layer_sums.hpp"
#include "bie/potentials/side.hpp"
#include "bie/potentials/smooth_grid.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Layer potentials at one target.
struct TargetValues {
  double single = 0.0, double_layer = 0.0;
  Vector3 single_gradient = Vector3::Zero(), double_gradient = Vector3::Zero();
  Vector3 stokes = Vector3::Zero(), stokes_double = Vector3::Zero();
  double enclosure = 0.0;  ///< D[1]
};

/// The sums with 1/(4π), 1/(8π) for the Stokes single layer at μ = 1 and 3/(4π) for the Stokes double layer.
/// Source: paper Eqs. (6), (9)
TargetValues with_prefactors(const LayerSums& sums);

/// D[1]: −1 inside, 0 outside, −½ on the membrane.
/// Source: Gauss's theorem
double enclosure_of(Side side);

/// One size per layer: of a change, or of what a change is small against.
struct LayerSizes {
  double single = 0.0, double_layer = 0.0, single_gradient = 0.0, double_gradient = 0.0, stokes = 0.0,
         stokes_double = 0.0;
};

/// Absolute change of every layer from one evaluation to another.
LayerSizes change(const TargetValues& a, const TargetValues& b);

/// Largest densities on the membrane: times √(area/4π) for the single layers, ∇_γ f for ∇D.
/// What a change of the layers is small against: units of each layer.
LayerSizes density_sizes(const SmoothGrid& grid, const NodeColumns& columns);

/// Whether every change is below the tolerance times its size.
bool is_small(const LayerSizes& change, const LayerSizes& sizes, double tolerance);

}  // namespace vehd
