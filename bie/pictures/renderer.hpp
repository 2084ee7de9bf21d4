#pragma once

#include <cstdint>
#include <vector>

#include "bie/pictures/colours.hpp"
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

/// Content of a picture, and how it is drawn.
struct RenderTask {
  Matrix3 view = Matrix3::Identity();  ///< rows: right, up, towards the eye
  double scale = 1.0;                  ///< pixels per unit of length
  int width = 0, height = 0;           ///< pixels; the origin is in the middle
  bool cut = false;                    ///< leaves out all parts nearer to the eye than the origin: the inside shows
};

/// Half width and half height of the mesh about the origin in a view, in units of length.
Eigen::Vector2d projected_extent(const RenderMesh& mesh, const Matrix3& view);

/// Parallel projection on white, lit from the upper left, antialiased; the inside is paler than the outside.
Image render(const RenderMesh& mesh, const ColourMap& colours, const RenderTask& task);

/// Intersection of the mesh with the plane through the origin perpendicular to the view: segments in (right, up), each
/// [x1, y1, x2, y2].
Matrix cut_lines(const RenderMesh& mesh, const Matrix3& view);

}  // namespace vehd
