#include "meshes/volume_mesh.hpp"

#include <algorithm>

namespace vehd::meshes {

int VolumeMesh::n_vesicles() const {
  int result = 0;
  for (const MeshCell& cell : topology_.cells) result = std::max(result, cell.vesicle + 1);
  return result;
}

std::vector<Point> VolumeMesh::vertex_positions() const {
  std::vector<Point> result(topology_.vertices.size(), Point::Zero());
  std::vector<bool> known(result.size(), false);
  for (int c = 0; c < n_cells(); ++c) {
    for (int v = 0; v < vertices_per_cell(cell_shape()); ++v) {
      const int vertex = cell(c).vertices[v];
      if (known[vertex]) continue;
      result[vertex] = physical(c, unit_vertex(cell_shape(), v));
      known[vertex] = true;
    }
  }
  return result;
}

Point VolumeMesh::across(const InterfacePair& pair, const Point& inside_unit) const {
  const std::array<double, 8> weights = vertex_functions(cell_shape(), inside_unit);
  const std::array<int, 4>& corners = face_vertices(cell_shape(), pair.inside_face);
  Point result = Point::Zero();
  for (int k = 0; k < 4 && corners[k] >= 0; ++k) {
    result += weights[corners[k]] * unit_vertex(cell_shape(), pair.outside_vertex[k]);
  }
  return result;
}

}  // namespace vehd::meshes
