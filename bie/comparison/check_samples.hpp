#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Points off the membrane at which φ and v are compared.
struct CheckSamples {
  Matrix points;      ///< [n_points x 3]
  Vector distance;    ///< from the membrane of the near ones; 0 for the others
  double near = 0.0;  ///< one grid spacing: what counts as near
};

/// Points within one grid spacing of the membrane on either side, and points further inside and outside.
CheckSamples check_samples(const Matrix& position);

}  // namespace vehd
