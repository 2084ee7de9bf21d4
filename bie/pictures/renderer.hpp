#pragma once

#include <cstdint>
#include <vector>

#include "bie/pictures/colour_map.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// 8-bit RGB, rows from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// A smooth closed surface as a fine triangulation.
struct RenderMesh {
  Matrix points;   ///< [n x 3]
  Matrix normals;  ///< [n x 3], outward unit normals of the true surface
  Vector shade;    ///< [n], position on the colour map, 0 ... 1
  std::vector<std::int64_t> triangles;
};

/// Looks at the origin from a point at the given distance; +z of the world is up.
struct Camera {
  double azimuth_deg = 0.0;    ///< of the eye, from the -y axis towards +x
  double elevation_deg = 0.0;  ///< of the eye above the x-y plane
  double distance = 10.0;
};

/// World coordinates to (right, up, towards the eye) of the camera.
Matrix3 camera_frame(const Camera& camera);

/// Half width and half height that the mesh covers in the plane through the origin, in units of length.
Eigen::Vector2d projected_extent(const RenderMesh& mesh, const Camera& camera);

/// Perspective picture on white, lit from the upper left, antialiased.
/// @param scale  pixels per unit of length at the origin
Image render(const RenderMesh& mesh, const Camera& camera, const ColourMap& colours, double scale, int width,
             int height);

}  // namespace vehd
