#pragma once

#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// w·∇_γ u at the Gauss points of γ, by derivatives of the polynomials through the points of each face.
/// @param rule      of which the faces, their coordinates and their order count; m² points on every face
/// @param position  x at the points, [3 x n], of any shape with these points
/// @param velocity  w there, of which the tangential part counts
/// @param value     u there
/// Accuracy: exact where x and u are polynomials of degree m − 1 in the face coordinates
/// (tests/fem_check/app/surface_transport_test.cpp)
Vector surface_transport(const SurfacePoints& rule, const Vectors& position, const Vectors& velocity,
                         const Vector& value);

}  // namespace vehd::fem_check
