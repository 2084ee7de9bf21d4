#pragma once

#include "bie/geometry/surface.hpp"
#include "bie/kernels/laplace.hpp"

namespace vehd::testing {

/// 1/(4π|x − source|) and its normal derivative on a surface.
struct PointPotential {
  Vector value, flux;
};

inline PointPotential point_potential(const Surface& surface, const Vector3& source) {
  const Matrix r = surface.position.rowwise() - source.transpose();
  const Vector inverse = r.rowwise().norm().cwiseInverse();
  const Vector along_normal = r.cwiseProduct(surface.normal).rowwise().sum();
  return {kLaplacePrefactor * inverse, -kLaplacePrefactor * along_normal.cwiseProduct(inverse.array().cube().matrix())};
}

}  // namespace vehd::testing
