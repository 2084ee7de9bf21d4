#pragma once

#include "bie/geometry/surface.hpp"
#include "tests/support/fields.hpp"

namespace vehd::testing {

/// Coefficients of the three vector harmonics of the unit sphere for one Y_nm.
struct VectorHarmonics {
  Matrix v;  ///< ∇Y − (n+1) Y r̂
  Matrix w;  ///< ∇Y + n Y r̂
  Matrix x;  ///< r̂ × ∇Y
};

inline VectorHarmonics vector_harmonics(const SphereTransform& fine, const Surface& unit_sphere, int n, int m) {
  const SphereDerivatives y = fine.synthesize_gradient(harmonic(fine.order(), n, m));
  const Matrix gradient = surface_gradient(unit_sphere, y);
  const Matrix radial = y.value.col(0).asDiagonal() * unit_sphere.normal;
  Matrix curl(gradient.rows(), 3);
  for (Index i = 0; i < curl.rows(); ++i) {
    curl.row(i) = Vector3(unit_sphere.normal.row(i)).cross(Vector3(gradient.row(i))).transpose();
  }
  return {fine.analyze(gradient - (n + 1.0) * radial), fine.analyze(gradient + n * radial), fine.analyze(curl)};
}

}  // namespace vehd::testing
