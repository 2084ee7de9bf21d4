#pragma once

#include <memory>
#include <vector>

#include "bie/potentials/layer_sums.hpp"
#include "bie/support/instruments.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Tolerance and limits of OffSurfaceLayers.
struct OffSurfaceSettings {
  /// Largest change from one rule to the next, relative to the largest density (times the radius √(area/4π) for the
  /// single layers, times its surface gradient for ∇D). The accepted value is that of the finer rule.
  double tolerance = 1e-9;
  /// Largest number of rules for a near target, each with a quarter more nodes in either direction.
  int max_rules = 9;
  /// Points nearer than this, relative to the radius, count as on the membrane and take the side stated in the call.
  double membrane_distance = 1e-12;
};

/// One layer at all targets.
struct LayerField {
  Matrix values;  ///< [n_targets x components], no columns if not requested
  Vector error;   ///< absolute estimate per target for the given densities: the last change
};

/// The layers at every target, all with one row per target.
struct OffSurfaceValues {
  LayerField laplace_single, laplace_single_gradient;
  LayerField laplace_double, laplace_double_gradient;
  LayerField stokes_single;  ///< at μ = 1
  LayerField stokes_double;
  std::vector<Side> side;  ///< of each target; for those on the membrane as stated in the call
  Vector distance;         ///< from the membrane; of far targets, from its nearest quadrature node
  Eigen::Array<bool, Eigen::Dynamic, 1> resolved;
};

/// Layer potentials of given densities at any points, near and far, inside and outside:
///   S[f](x) = ∫ G f dA, D[f](x) = ∫ ∂G/∂n(y) f dA, their gradients, and both Stokes layers, Eqs. (6), (8), (9) and
/// stokes_double_kernel.
/// Far targets use the smooth rule of upsampled grids. Near targets use a rule whose pole is the nearest point y0 of
/// the membrane and whose nodes cluster there on the scale of the distance (GradedRule), positions relative to y0 to
/// avoid cancellation, and
///   D[f] = D[f − f(y0)] + f(y0) D[1], D[1] = −1 inside, 0 outside, −½ on the membrane,
///   ∇D[f] = ∫ ∇G × (n×∇_γ f) dA,
/// the Stokes double layer like D, instead of the strongly singular forms. Rules of increasing size are tried at every
/// target until two agree.
///
/// Accuracy: that of the densities and of the surface at degree p, at any distance (docs/near_membrane.md). Layers of
/// harmonics on a sphere to 1e-9 at every distance on either side (tests/potentials/off_surface_test.cpp).
///
/// Source: paper Eqs. (6), (8), (9); D[1] of Gauss's theorem
class OffSurfaceLayers {
 public:
  /// @param position  coefficients of the membrane, [n_coefficients x 3]
  /// @throws ShapeError if a density does not match the order of the surface
  OffSurfaceLayers(const Matrix& position, LayerDensities densities, const OffSurfaceSettings& settings = {});
  ~OffSurfaceLayers();
  OffSurfaceLayers(OffSurfaceLayers&&) noexcept;
  OffSurfaceLayers& operator=(OffSurfaceLayers&&) noexcept;

  /// All layers that have densities. Bit-identical for any number of threads. Targets whose rules do not converge keep
  /// the last values and are not `resolved`.
  /// @param points  [n_targets x 3]
  /// @param side    limit taken at points on the membrane; that of others follows from their position
  /// @throws ConvergenceError if the nearest point of the membrane cannot be found
  [[nodiscard]] OffSurfaceValues evaluate(const Matrix& points, Side side, Instruments& instruments) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// @param points  the targets, [n_targets x 3]
/// @throws ConvergenceError naming the first target that is not resolved, with its distance
void require_resolved(const OffSurfaceValues& values, const Matrix& points);

}  // namespace vehd
