#pragma once

#include "bie/potentials/layer_operators.hpp"

namespace vehd {

/// Which columns of the assembled rows belong to which layer: one for a scalar layer, six for a Stokes layer, −1 for a
/// layer that is not selected.
struct KernelColumns {
  int single = -1, double_layer = -1, adjoint = -1, stokes = -1, stokes_double = -1, hypersingular = -1;
  int count = 0;
  bool plain = false;  ///< see LayerSelection

  /// Columns in the order of the selection's members.
  explicit KernelColumns(const LayerSelection& selection) : plain(selection.plain) {
    if (selection.laplace_single) single = count++;
    if (selection.laplace_double) double_layer = count++;
    if (selection.laplace_adjoint) adjoint = count++;
    if (selection.stokes_single) {
      stokes = count;
      count += 6;
    }
    if (selection.stokes_double) {
      stokes_double = count;
      count += 6;
    }
    if (selection.laplace_hypersingular) hypersingular = count++;
  }

  /// Whether the kernels contain the normal or the area element at the source.
  [[nodiscard]] bool need_source_normal() const {
    return double_layer >= 0 || stokes_double >= 0 || hypersingular >= 0 || plain;
  }
  /// Whether the operator of the Stokes single layer is symmetric.
  [[nodiscard]] bool has_symmetric_stokes() const { return stokes >= 0 && !plain; }
  /// Block xx, xy, xz, yy, yz, zz of a Stokes layer that a column belongs to, −1 for scalar kernels.
  [[nodiscard]] int stokes_block(int column) const {
    for (const int first : {stokes, stokes_double}) {
      if (first >= 0 && column >= first && column < first + 6) return column - first;
    }
    return -1;
  }
};

}  // namespace vehd
