#pragma once

#include <array>
#include <vector>

#include "meshes/types.hpp"

/// Cells, faces and the interface of a volume mesh, in deal.II's numbering.
namespace vehd::meshes {

/// Shape of all cells of a mesh.
enum class CellShape { hexahedron, tetrahedron };
/// Side of the membrane that a cell lies on.
enum class Region { inside = 0, outside = 1 };
/// Surface on which a face of a cell lies.
enum class FaceKind { interior, membrane, outer_sphere, wall };

/// Hexahedron: vertex v has the unit coordinates (v & 1, v >> 1 & 1, v >> 2 & 1); faces x = 0, x = 1, y = 0, y = 1,
/// z = 0, z = 1. Tetrahedron: vertices (0,0,0), (1,0,0), (0,1,0), (0,0,1); faces {0,1,2}, {1,0,3}, {0,2,3}, {2,1,3}.
/// Unused entries of a tetrahedron are −1 and FaceKind::interior. Every cell is right-handed.
struct MeshCell {
  std::array<int, 8> vertices;
  Region region;
  std::array<FaceKind, 6> faces;
  int vesicle = 0;  ///< vesicle that contains the cell; outside, the vesicle whose blocks it belongs to
};

/// One face of the membrane seen from both sides.
struct InterfacePair {
  int inside_cell;
  int inside_face;
  int outside_cell;
  int outside_face;
  /// Number within the outside cell of the vertex that coincides with face_vertices(inside_face)[k] of the inside cell;
  /// −1 for the missing fourth vertex of a triangle.
  std::array<int, 4> outside_vertex;
};

/// Cells of a mesh, and the pairs of their faces that meet on the membrane.
struct MeshTopology {
  CellShape shape = CellShape::hexahedron;
  /// Block meshes: reference coordinates (BlockMap). Tetrahedra: positions in space.
  std::vector<Point> vertices;
  std::vector<MeshCell> cells;
  std::vector<InterfacePair> interface;
  /// {inside vertex, outside vertex} at one point of γ: different numbers if the interface is split, equal if not.
  std::vector<std::array<int, 2>> interface_vertices;
};

/// 8 for a hexahedron, 4 for a tetrahedron.
int vertices_per_cell(CellShape shape);
/// 6 for a hexahedron, 4 for a tetrahedron.
int faces_per_cell(CellShape shape);
/// Vertex numbers within a cell of one of its faces, in deal.II's order; the fourth is −1 for a triangle.
const std::array<int, 4>& face_vertices(CellShape shape, int face);
/// Unit coordinates of one vertex.
Point unit_vertex(CellShape shape, int vertex);
/// Values of the (tri)linear vertex functions at a point of the unit cell; a tetrahedron uses the first 4 entries.
std::array<double, 8> vertex_functions(CellShape shape, const Point& unit);

/// Fills `interface` and `interface_vertices` from the faces marked as membrane.
/// @throws MeshError if a membrane face has no partner on the other side
void find_interface(MeshTopology& topology);

/// Gives the outside cells their own vertices on γ, so that inside and outside share none. Requires find_interface()
/// first.
void split_interface(MeshTopology& topology);

}  // namespace vehd::meshes
