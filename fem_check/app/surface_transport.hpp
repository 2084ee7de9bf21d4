#pragma once

#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// w·∇_γ u at the Gauss points of γ, by differentiating the polynomials through the points of each face.
/// @param rule      provides faces, face coordinates and order of the points; m² points on every face
/// @param position  x at the points, [3 x n], of any shape with these points
/// @param velocity  w at the points, [3 x n_points]; only its tangential part is used
/// @param value     u at the points, [n_points]
/// Accuracy: exact if x and u are polynomials of degree m − 1 in the face coordinates
/// (tests/fem_check/app/surface_transport_test.cpp)
Vector surface_transport(const SurfacePoints& rule, const Vectors& position, const Vectors& velocity,
                         const Vector& value);

}  // namespace vehd::fem_check
