#pragma once

#include <array>

#include "bie/sphere/transform.hpp"

namespace vehd {

/// Values of a field where the line through a point along ±direction leaves the surface for good, along + first: what
/// highest_on_line finds there; not a number where the line misses it.
/// @param direction  not zero; along z where the transform knows axisymmetric fields alone
/// @param fine       whose grid has as many longitudes as the degree asks for
/// @param point      relative to the mean of the position
/// @param position, field  coefficients
/// Accuracy: rounding; of V = z on turned ellipsoids to 1e-12 (tests/stepping/evaluation/diagnostics_test.cpp)
std::array<double, 2> values_at_poles(const Vector3& direction, const SphereTransform& fine, const Vector3& point,
                                      const Matrix& position, const Vector& field);

}  // namespace vehd
