#pragma once

#include <memory>

#include "bie/potentials/near_rows.hpp"
#include "bie/potentials/smooth_grid.hpp"
#include "bie/support/instruments.hpp"

namespace vehd {

/// Tolerance and limits of PairLayers.
struct PairSettings {
  /// Error of the rules relative to the largest density, times the radius √(area/4π) of the source for the single
  /// layers.
  double tolerance = 1e-10;
  /// Largest number of rules for near targets, each with a quarter more nodes in either direction.
  int max_rules = 9;
  /// Largest memory of rows of far targets. Rows of a Stokes layer cost as much as about twenty sums over the nodes,
  /// those of a scalar layer about five, and are applied in a fraction of the time of one sum. This pays for layers
  /// that are applied often: N·∇S, N·∇D and the Stokes double layer. Targets beyond the limit, and all targets of the
  /// other layers, are summed at every application.
  double row_bytes = 1e9;
};

/// Number of targets by method.
struct PairCounts {
  Index far = 0;       ///< by the smooth rule
  Index near = 0;      ///< by rows of coefficients
  Index expanded = 0;  ///< by multipole expansions
};

/// Makes the transforms that layers of membranes of this degree need; all membranes and steps share them.
void prepare_pair_transforms(int order, SharedTransforms& transforms);

/// Layers of one membrane at points of another, all outside the first, as linear maps that are made once and applied
/// many times. Far targets use the smooth rule of a grid as coarse as their distance allows. Near targets use the rule
/// about the nearest point (near_rows), whose adjoint gives a row over the coefficients of the density. If no layer is
/// selected, the targets are only sorted. Applications are sums in fixed order, bit-identical for any number of
/// threads.
///
/// Accuracy: the tolerance, times the density, at every gap; layers of given densities on two shapes without symmetry
/// at gaps from 1e-3 to 10 to 1e-9 (tests/potentials/pair_layers_test.cpp)
///
/// Source: paper Eqs. (6), (8), (9) with source and target on different membranes
class PairLayers {
 public:
  /// @param source   coefficients of the source membrane, [n_coefficients x 3]
  /// @param points   targets, [n_targets x 3]
  /// @param normals  N at the targets, [n_targets x 3]
  /// @param transforms  missing ones are made
  /// @param plane       for images, whose targets are beyond it
  /// @throws ConvergenceError if the nearest point of a target is not found, a target is not outside the source, or the
  /// rules do not converge
  PairLayers(const Matrix& source, const Matrix& points, const Matrix& normals, const PairSelection& selection,
             const PairSettings& settings, SharedTransforms& transforms, Instruments& instruments,
             const MirrorPlane& plane = {});
  ~PairLayers();
  PairLayers(PairLayers&&) noexcept;
  PairLayers& operator=(PairLayers&&) noexcept;

  /// A layer at the targets.
  /// @param density  coefficients of the density, see PairLayer; [n_coefficients x 1], of a Stokes layer
  ///                 [n_coefficients x 3]
  /// @return         [n_targets x 1] or [n_targets x 3]
  /// @throws std::logic_error if the layer was not selected
  /// @throws ShapeError for a density of another degree
  [[nodiscard]] Matrix apply(PairLayer layer, const Matrix& density) const;

  [[nodiscard]] const PairCounts& counts() const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

}  // namespace vehd
