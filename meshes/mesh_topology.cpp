#include "meshes/mesh_topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace vehd::meshes {
namespace {

struct FacePlace {
  int cell;
  int face;
};

/// Sorted vertices of a face: equal for the two cells that share it.
std::array<int, 4> face_key(const MeshTopology& topology, const FacePlace& place) {
  std::array<int, 4> key;
  const std::array<int, 4>& corners = face_vertices(topology.shape, place.face);
  for (int k = 0; k < 4; ++k) key[k] = corners[k] < 0 ? -1 : topology.cells[place.cell].vertices[corners[k]];
  std::sort(key.begin(), key.end());
  return key;
}

/// Number within a cell of a vertex of the mesh.
int local_vertex(const MeshCell& cell, int vertex) {
  return static_cast<int>(std::find(cell.vertices.begin(), cell.vertices.end(), vertex) - cell.vertices.begin());
}

template <typename Visit>
void for_each_membrane_face(const MeshTopology& topology, Region region, const Visit& visit) {
  for (int c = 0; c < static_cast<int>(topology.cells.size()); ++c) {
    if (topology.cells[c].region != region) continue;
    for (int f = 0; f < faces_per_cell(topology.shape); ++f) {
      if (topology.cells[c].faces[f] == FaceKind::membrane) visit(FacePlace{c, f});
    }
  }
}

[[noreturn]] void throw_without_partner(const MeshTopology& topology, const FacePlace& place) {
  const Point x = topology.vertices[topology.cells[place.cell].vertices[face_vertices(topology.shape, place.face)[0]]];
  throw MeshError(
      fmt::format("a membrane face of cell {} at ({:.6g}, {:.6g}, {:.6g}) has no partner across the membrane",
                  place.cell, x.x(), x.y(), x.z()));
}

}  // namespace

int vertices_per_cell(CellShape shape) { return shape == CellShape::hexahedron ? 8 : 4; }

int faces_per_cell(CellShape shape) { return shape == CellShape::hexahedron ? 6 : 4; }

const std::array<int, 4>& face_vertices(CellShape shape, int face) {
  static constexpr std::array<std::array<int, 4>, 6> kHexahedron{
      {{0, 2, 4, 6}, {1, 3, 5, 7}, {0, 4, 1, 5}, {2, 6, 3, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}}};
  static constexpr std::array<std::array<int, 4>, 4> kTetrahedron{
      {{0, 1, 2, -1}, {1, 0, 3, -1}, {0, 2, 3, -1}, {2, 1, 3, -1}}};
  return shape == CellShape::hexahedron ? kHexahedron.at(face) : kTetrahedron.at(face);
}

Point unit_vertex(CellShape shape, int vertex) {
  if (shape == CellShape::hexahedron) return Point(vertex & 1, vertex >> 1 & 1, vertex >> 2 & 1);
  return vertex == 0 ? Point(Point::Zero()) : Point(Point::Unit(vertex - 1));
}

std::array<double, 8> vertex_functions(CellShape shape, const Point& unit) {
  std::array<double, 8> result{};
  if (shape == CellShape::tetrahedron) {
    result[0] = 1.0 - unit.x() - unit.y() - unit.z();
    for (int k = 0; k < 3; ++k) result[k + 1] = unit[k];
    return result;
  }
  for (int v = 0; v < 8; ++v) {
    result[v] = ((v & 1) ? unit.x() : 1.0 - unit.x()) * ((v & 2) ? unit.y() : 1.0 - unit.y()) *
                ((v & 4) ? unit.z() : 1.0 - unit.z());
  }
  return result;
}

void find_interface(MeshTopology& topology) {
  std::map<std::array<int, 4>, FacePlace> inside;
  for_each_membrane_face(topology, Region::inside,
                         [&](const FacePlace& place) { inside[face_key(topology, place)] = place; });
  topology.interface.clear();
  std::set<int> vertices;
  for_each_membrane_face(topology, Region::outside, [&](const FacePlace& place) {
    const auto partner = inside.find(face_key(topology, place));
    if (partner == inside.end()) throw_without_partner(topology, place);
    const FacePlace in = partner->second;
    inside.erase(partner);
    InterfacePair pair{in.cell, in.face, place.cell, place.face, {-1, -1, -1, -1}};
    const std::array<int, 4>& corners = face_vertices(topology.shape, in.face);
    for (int k = 0; k < 4 && corners[k] >= 0; ++k) {
      const int vertex = topology.cells[in.cell].vertices[corners[k]];
      pair.outside_vertex[k] = local_vertex(topology.cells[place.cell], vertex);
      vertices.insert(vertex);
    }
    topology.interface.push_back(pair);
  });
  if (!inside.empty()) throw_without_partner(topology, inside.begin()->second);
  topology.interface_vertices.clear();
  for (const int vertex : vertices) topology.interface_vertices.push_back({vertex, vertex});
}

void split_interface(MeshTopology& topology) {
  std::map<int, int> copy_of;
  for (std::array<int, 2>& pair : topology.interface_vertices) {
    if (pair[0] != pair[1]) continue;  // already split
    pair[1] = static_cast<int>(topology.vertices.size());
    copy_of[pair[0]] = pair[1];
    topology.vertices.push_back(Point(topology.vertices[pair[0]]));
  }
  for (MeshCell& cell : topology.cells) {
    if (cell.region != Region::outside) continue;
    for (int& vertex : cell.vertices) {
      if (const auto copy = copy_of.find(vertex); copy != copy_of.end()) vertex = copy->second;
    }
  }
}

}  // namespace vehd::meshes
