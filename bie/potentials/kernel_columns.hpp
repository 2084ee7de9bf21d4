#pragma once

#include "bie/potentials/layer_operators.hpp"

namespace vehd {

/// What each column of the assembled rows means.
struct KernelColumns {
  int single = -1, double_layer = -1, adjoint = -1, stokes = -1;
  int count = 0;

  explicit KernelColumns(const LayerSelection& selection) {
    if (selection.laplace_single) single = count++;
    if (selection.laplace_double) double_layer = count++;
    if (selection.laplace_adjoint) adjoint = count++;
    if (selection.stokes_single) {
      stokes = count;
      count += 6;
    }
  }
};

}  // namespace vehd
