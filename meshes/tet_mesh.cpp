#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "meshes/membrane_faces.hpp"
#include "meshes/mesh_quality.hpp"
#include "meshes/sphere_triangulation.hpp"
#include "meshes/tetrahedron_filler.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {
namespace {

constexpr std::array<std::array<int, 2>, 6> kEdges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

using Weights = Eigen::Matrix<double, 10, 1>;
using WeightSlopes = Eigen::Matrix<double, 10, 3>;

std::array<double, 4> barycentric(const Point& unit) {
  return {1.0 - unit.x() - unit.y() - unit.z(), unit.x(), unit.y(), unit.z()};
}

/// Quadratic node functions: λ(2λ − 1) at vertices, 4 λ_a λ_b at edge midpoints.
Weights node_functions(const Point& unit) {
  const std::array<double, 4> l = barycentric(unit);
  Weights result;
  for (int v = 0; v < 4; ++v) result[v] = l[v] * (2.0 * l[v] - 1.0);
  for (int e = 0; e < 6; ++e) result[4 + e] = 4.0 * l[kEdges[e][0]] * l[kEdges[e][1]];
  return result;
}

WeightSlopes node_slopes(const Point& unit) {
  const std::array<double, 4> l = barycentric(unit);
  const auto slope = [](int v) { return v == 0 ? Point(Point::Constant(-1.0)) : Point(Point::Unit(v - 1)); };
  WeightSlopes result;
  for (int v = 0; v < 4; ++v) result.row(v) = (4.0 * l[v] - 1.0) * slope(v).transpose();
  for (int e = 0; e < 6; ++e) {
    const auto [a, b] = kEdges[e];
    result.row(4 + e) = 4.0 * (l[a] * slope(b) + l[b] * slope(a)).transpose();
  }
  return result;
}

}  // namespace

TetMesh::TetMesh(MeshTopology topology, std::vector<Nodes> nodes, const Point& centre, double outer_radius)
    : VolumeMesh(std::move(topology), centre, outer_radius), nodes_(std::move(nodes)) {}

Point TetMesh::physical(int cell_index, const Point& unit) const {
  return nodes_[cell_index].position * node_functions(unit);
}

std::vector<Point> TetMesh::physical_points(int cell_index, const std::vector<Point>& units) const {
  std::vector<Point> result;
  result.reserve(units.size());
  for (const Point& unit : units) result.push_back(physical(cell_index, unit));
  return result;
}

Matrix3 TetMesh::jacobian(int cell_index, const Point& unit) const {
  return nodes_[cell_index].position * node_slopes(unit);
}

Point TetMesh::direction(int cell_index, const Point& unit) const {
  // Node functions of nodes off a face vanish on it, so the zero directions of these nodes do not contribute.
  const auto& faces = cell(cell_index).faces;
  if (std::find(faces.begin(), faces.end(), FaceKind::membrane) == faces.end()) {
    throw std::logic_error(fmt::format("cell {} has no membrane face: no point of it has a direction", cell_index));
  }
  return (nodes_[cell_index].direction * node_functions(unit)).normalized();
}

namespace {

void require(bool holds, const char* what, double value) {
  if (!holds) throw std::invalid_argument(fmt::format("tetrahedral mesh: {} is {}, but must be positive", what, value));
}

/// A curved surface of the mesh; its vertices are numbered in the mesh from `first_vertex`.
struct CurvedSurface {
  const SphereTriangulation& sphere;
  int first_vertex;
  FaceKind kind;
};

using Edge = std::array<int, 2>;
using Face = std::array<int, 3>;

Edge sorted_edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

Face sorted_face(Face face) {
  std::sort(face.begin(), face.end());
  return face;
}

/// Midpoints of curved edges with their directions (zero off the membrane), and the faces on curved surfaces.
struct CurvedParts {
  std::map<Edge, Point> midpoint;
  std::map<Edge, Point> membrane_direction;
  std::map<Face, FaceKind> face;
};

template <typename Position>
void add_curved(const CurvedSurface& surface, const Position& position, CurvedParts& parts) {
  for (const Face& triangle : surface.sphere.triangles) {
    Face face = triangle;
    for (int& v : face) v += surface.first_vertex;
    parts.face[sorted_face(face)] = surface.kind;
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const Edge edge = sorted_edge(face[k], face[next]);
      if (parts.midpoint.contains(edge)) continue;
      const Point direction =
          (surface.sphere.directions[triangle[k]] + surface.sphere.directions[triangle[next]]).normalized();
      parts.midpoint[edge] = position(direction);
      if (surface.kind == FaceKind::membrane) parts.membrane_direction[edge] = direction;
    }
  }
}

MeshCell make_cell(const std::array<int, 4>& vertices, Region region, const CurvedParts& parts) {
  MeshCell cell;
  cell.vertices.fill(-1);
  std::copy(vertices.begin(), vertices.end(), cell.vertices.begin());
  cell.region = region;
  cell.faces.fill(FaceKind::interior);
  for (int f = 0; f < 4; ++f) {
    const auto& corners = face_vertices(CellShape::tetrahedron, f);
    const auto known = parts.face.find(sorted_face({vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]}));
    if (known != parts.face.end()) cell.faces[f] = known->second;
  }
  return cell;
}

TetMesh::Nodes make_nodes(const MeshCell& cell, const std::vector<Point>& vertices, const SphereTriangulation& membrane,
                          const CurvedParts& parts) {
  TetMesh::Nodes nodes;
  nodes.direction.setZero();
  for (int k = 0; k < 4; ++k) {
    const auto v = static_cast<std::size_t>(cell.vertices[k]);
    nodes.position.col(k) = vertices[v];
    if (v < membrane.directions.size()) nodes.direction.col(k) = membrane.directions[v];
  }
  for (int e = 0; e < 6; ++e) {
    const Edge edge = sorted_edge(cell.vertices[kEdges[e][0]], cell.vertices[kEdges[e][1]]);
    const auto curved = parts.midpoint.find(edge);
    nodes.position.col(4 + e) =
        curved != parts.midpoint.end() ? curved->second : Point(0.5 * (vertices[edge[0]] + vertices[edge[1]]));
    const auto direction = parts.membrane_direction.find(edge);
    if (direction != parts.membrane_direction.end()) nodes.direction.col(4 + e) = direction->second;
  }
  return nodes;
}

template <typename Position>
ClosedSurface mapped(const SphereTriangulation& sphere, const Position& position) {
  ClosedSurface surface{{}, sphere.triangles};
  for (const Point& direction : sphere.directions) surface.vertices.push_back(position(direction));
  return surface;
}

double distance_to(const std::vector<Point>& points, const Point& x) {
  double smallest = std::numeric_limits<double>::max();
  for (const Point& p : points) smallest = std::min(smallest, (p - x).squaredNorm());
  return std::sqrt(smallest);
}

/// Mesh whose quality has not been checked.
TetMesh filled_with_curved_tetrahedra(const FrozenShape& shape, const TetMeshOptions& options) {
  const Point centre = shape.centroid();
  const double reach = shape.largest_distance(centre);
  const double radius = options.outer_radius;
  if (!(radius > reach)) {
    throw MeshError(fmt::format(
        "outer radius {:.6g} does not enclose the membrane, which reaches {:.6g} from its centroid", radius, reach));
  }
  const double surface_size = options.surface_size * shape.radius();
  const auto size_at_distance = [&](double distance) {
    return std::min(surface_size + options.growth * distance, options.largest_size * shape.radius());
  };
  const auto on_membrane = [&](const Point& direction) { return shape.position(direction); };
  const auto on_sphere = [&](const Point& direction) { return Point(centre + radius * direction); };

  // Triangles are stretched as x(θ, φ) is; their area is that of equilateral triangles with the required edge length.
  const SphereTriangulation membrane = triangulate_sphere(
      [&](const Point& direction) { return surface_size / std::sqrt(shape.area_vector(direction).norm()); });
  const ClosedSurface inner = mapped(membrane, on_membrane);
  const SphereTriangulation sphere = triangulate_sphere([&](const Point& direction) {
    return size_at_distance(distance_to(inner.vertices, on_sphere(direction))) / radius;
  });
  FilledVolumes filled = fill_with_tetrahedra(inner, mapped(sphere, on_sphere), [&](const Point& x) {
    return size_at_distance(distance_to(inner.vertices, x));
  });
  separate_membrane_faces(filled, inner.triangles);

  CurvedParts parts;
  add_curved({membrane, 0, FaceKind::membrane}, on_membrane, parts);
  add_curved({sphere, static_cast<int>(membrane.directions.size()), FaceKind::outer_sphere}, on_sphere, parts);
  MeshTopology topology;
  topology.shape = CellShape::tetrahedron;
  topology.vertices = filled.vertices;
  for (const auto& cell : filled.inside) topology.cells.push_back(make_cell(cell, Region::inside, parts));
  for (const auto& cell : filled.shell) topology.cells.push_back(make_cell(cell, Region::outside, parts));
  std::vector<TetMesh::Nodes> nodes;
  for (const MeshCell& cell : topology.cells) nodes.push_back(make_nodes(cell, topology.vertices, membrane, parts));
  find_interface(topology);
  split_interface(topology);
  return {std::move(topology), std::move(nodes), centre, radius};
}

}  // namespace

TetMesh make_tetrahedral_mesh(const FrozenShape& shape, const TetMeshOptions& options) {
  require(options.surface_size > 0.0, "surface_size", options.surface_size);
  require(options.growth > 0.0, "growth", options.growth);
  require(options.largest_size > 0.0, "largest_size", options.largest_size);
  constexpr int kGaussPoints = 3;
  constexpr int kFurtherAttempts = 2;
  TetMeshOptions tried = options;
  for (int attempt = 0;; ++attempt) {
    TetMesh mesh = filled_with_curved_tetrahedra(shape, tried);
    const MeshQuality found = quality(mesh, shape, kGaussPoints);
    if (found.smallest_scaled_jacobian >= options.smallest_scaled_jacobian) return mesh;
    if (attempt == kFurtherAttempts) require_quality(found, options.smallest_scaled_jacobian);
    // A single element can be too flat by chance; a slightly different size changes all elements.
    tried.surface_size *= 0.97;
  }
}

}  // namespace vehd::meshes
