#include "meshes/tetrahedron_filler.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <Eigen/LU>
#include <cstddef>
#include <map>
#include <numeric>
#include <string>

#include "meshes/gmsh_session.hpp"

namespace vehd::meshes {
namespace {

constexpr int kTriangle = 2;  // gmsh's element types
constexpr int kTetrahedron = 4;
constexpr double kHxt = 10;  // gmsh's algorithms
constexpr double kDelaunay = 1;

void add_surface(int tag, const ClosedSurface& surface, std::size_t first_node) {
  std::vector<std::size_t> node_tags(surface.vertices.size());
  std::iota(node_tags.begin(), node_tags.end(), first_node);
  std::vector<double> positions;
  for (const Point& x : surface.vertices) positions.insert(positions.end(), x.begin(), x.end());
  std::vector<std::size_t> corners;
  for (const auto& triangle : surface.triangles) {
    for (const int v : triangle) corners.push_back(first_node + v);
  }
  gmsh::model::addDiscreteEntity(2, tag);
  gmsh::model::mesh::addNodes(2, tag, node_tags, positions);
  gmsh::model::mesh::addElementsByType(tag, kTriangle, {}, corners);
}

using NodeIndex = std::map<std::size_t, int>;

NodeIndex read_nodes(std::vector<Point>& vertices) {
  std::vector<std::size_t> tags;
  std::vector<double> x;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters);
  std::map<std::size_t, Point> sorted;
  for (std::size_t i = 0; i < tags.size(); ++i) sorted[tags[i]] = Point(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
  NodeIndex index;
  for (const auto& [tag, position] : sorted) {
    index[tag] = static_cast<int>(vertices.size());
    vertices.push_back(position);
  }
  return index;
}

std::vector<std::array<int, 4>> read_tetrahedra(int volume, const NodeIndex& index,
                                                const std::vector<Point>& vertices) {
  std::vector<std::size_t> tags;
  std::vector<std::size_t> nodes;
  gmsh::model::mesh::getElementsByType(kTetrahedron, tags, nodes, volume);
  std::vector<std::array<int, 4>> result;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    std::array<int, 4> cell;
    for (int k = 0; k < 4; ++k) cell[k] = index.at(nodes[4 * i + k]);
    Matrix3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = vertices[cell[k + 1]] - vertices[cell[0]];
    if (edges.determinant() < 0.0) std::swap(cell[2], cell[3]);
    result.push_back(cell);
  }
  return result;
}

FilledVolumes fill(const ClosedSurface& inner, const ClosedSurface& outer,
                   const std::function<double(const Point&)>& edge_length, double algorithm) {
  const GmshSession session;
  gmsh::option::setNumber("Mesh.Algorithm3D", algorithm);
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
  gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
  add_surface(1, inner, 1);
  add_surface(2, outer, 1 + inner.vertices.size());
  const int inner_loop = gmsh::model::geo::addSurfaceLoop({1});
  const int outer_loop = gmsh::model::geo::addSurfaceLoop({2});
  const int inside = gmsh::model::geo::addVolume({inner_loop});
  const int shell = gmsh::model::geo::addVolume({outer_loop, inner_loop});
  gmsh::model::geo::synchronize();
  // Recent versions of gmsh also pass the size that they would choose.
  gmsh::model::mesh::setSizeCallback(
      [&](int, int, double x, double y, double z, auto... /*size*/) { return edge_length(Point(x, y, z)); });
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::removeSizeCallback();
  FilledVolumes result;
  const NodeIndex index = read_nodes(result.vertices);
  result.inside = read_tetrahedra(inside, index, result.vertices);
  result.shell = read_tetrahedra(shell, index, result.vertices);
  if (result.inside.empty() || result.shell.empty()) throw std::string("a volume was left empty");
  return result;
}

}  // namespace

FilledVolumes fill_with_tetrahedra(const ClosedSurface& inner, const ClosedSurface& outer,
                                   const std::function<double(const Point& position)>& edge_length) {
  std::string reasons;
  // Delaunay first: HXT keeps random numbers between calls, so its meshes depend on what was meshed before.
  for (const double algorithm : {kDelaunay, kHxt}) {
    try {
      return fill(inner, outer, edge_length, algorithm);
    } catch (...) {
      reasons += fmt::format(" {}: {}.", algorithm == kHxt ? "HXT" : "Delaunay", gmsh_message());
    }
  }
  throw MeshError("gmsh cannot fill the shape with tetrahedra;" + reasons);
}

}  // namespace vehd::meshes
