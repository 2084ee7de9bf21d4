#include "meshes/sphere_triangulation.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <map>

#include "meshes/gmsh_session.hpp"

namespace vehd::meshes {
namespace {

/// Builds the unit sphere from 8 octants between the axes.
void build_octants() {
  namespace geo = gmsh::model::geo;
  const int centre = geo::addPoint(0.0, 0.0, 0.0);
  std::array<std::array<int, 2>, 3> pole;  // [axis][side]
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Point x = (side ? 1.0 : -1.0) * Point::Unit(axis);
      pole[axis][side] = geo::addPoint(x.x(), x.y(), x.z());
    }
  }
  // arc[axis][side][next side]: from the pole of one axis to a pole of the next axis.
  std::array<std::array<std::array<int, 2>, 2>, 3> arc;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      for (int next = 0; next < 2; ++next) {
        arc[axis][side][next] = geo::addCircleArc(pole[axis][side], centre, pole[(axis + 1) % 3][next]);
      }
    }
  }
  for (int octant = 0; octant < 8; ++octant) {
    const std::array<int, 3> side{octant & 1, octant >> 1 & 1, octant >> 2 & 1};
    const int loop = geo::addCurveLoop({arc[0][side[0]][side[1]], arc[1][side[1]][side[2]], arc[2][side[2]][side[0]]});
    geo::addSurfaceFilling({loop}, -1, centre);
  }
  geo::synchronize();
}

std::map<std::size_t, int> read_directions(SphereTriangulation& result) {
  std::vector<std::size_t> tags;
  std::vector<std::size_t> element_tags;
  std::vector<std::size_t> nodes;
  std::vector<double> x;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters);
  std::map<std::size_t, Point> sorted;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const Point position(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
    // The common centre of the arcs is a node without elements.
    if (position.norm() > 0.5) sorted[tags[i]] = position.normalized();
  }
  std::map<std::size_t, int> index;
  for (const auto& [tag, direction] : sorted) {
    index[tag] = static_cast<int>(result.directions.size());
    result.directions.push_back(direction);
  }
  return index;
}

}  // namespace

SphereTriangulation triangulate_sphere(const std::function<double(const Point& direction)>& edge_length) {
  constexpr int kTriangle = 2;  // gmsh's element type
  constexpr double kFrontalDelaunay = 6;
  const GmshSession session;
  SphereTriangulation result;
  std::vector<std::size_t> tags;
  std::vector<std::size_t> nodes;
  try {
    build_octants();
    gmsh::option::setNumber("Mesh.Algorithm", kFrontalDelaunay);
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    // Recent versions of gmsh also pass the size that they would choose.
    gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double z, auto... /*size*/) {
      return edge_length(Point(x, y, z).normalized());
    });
    gmsh::model::mesh::generate(2);
    gmsh::model::mesh::removeSizeCallback();
    gmsh::model::mesh::getElementsByType(kTriangle, tags, nodes);
  } catch (...) {
    throw MeshError("gmsh cannot triangulate the sphere: " + gmsh_message());
  }
  const std::map<std::size_t, int> index = read_directions(result);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    std::array<int, 3> triangle{index.at(nodes[3 * i]), index.at(nodes[3 * i + 1]), index.at(nodes[3 * i + 2])};
    const Point& a = result.directions[triangle[0]];
    const Point& b = result.directions[triangle[1]];
    const Point& c = result.directions[triangle[2]];
    if ((b - a).cross(c - a).dot(a + b + c) < 0.0) std::swap(triangle[1], triangle[2]);
    result.triangles.push_back(triangle);
  }
  const auto euler = static_cast<long>(result.directions.size()) - static_cast<long>(result.triangles.size()) / 2;
  if (euler != 2) {
    throw MeshError(fmt::format("gmsh's triangulation of the sphere is not closed: {} vertices, {} triangles",
                                result.directions.size(), result.triangles.size()));
  }
  return result;
}

}  // namespace vehd::meshes
