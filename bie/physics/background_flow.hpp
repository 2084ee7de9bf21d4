#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Linear background flow v_inf(x) = gradient * x, gradient(i, j) = dv_i/dx_j, trace zero.
struct BackgroundFlow {
  Matrix3 gradient = Matrix3::Zero();
};

/// v = rate (z, 0, 0): flow along x, gradient along z.
BackgroundFlow shear_flow(double rate);
/// v = rate (x, 0, -z).
BackgroundFlow planar_extension(double rate);
/// v = rate (-x/2, -y/2, z).
BackgroundFlow axisymmetric_extension(double rate);

}  // namespace vehd
