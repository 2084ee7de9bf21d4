#pragma once

#include <string>
#include <vector>

#include "bie/scene/scene.hpp"
#include "bie/support/types.hpp"

/// Parallel projections: directions to the right, upwards and towards the eye.
namespace vehd {

/// "x" (y to the right, z upwards), "y" (x to the right, z upwards), "z" (x to the right, y upwards) or a direction
/// towards the eye, "1,1,0.5".
/// @throws InputError for anything else
Matrix3 parse_view(const std::string& text);

/// View perpendicular to the plane of flow and field: along the axis with the least of these and gravity (y if several
/// have none), or obliquely with less. If none decides, the axis of a body of revolution lies in the plane.
/// @param gyration  of the first shape, any scale
Matrix3 default_view(const Scene& scene, const Matrix3& gyration);

}  // namespace vehd
