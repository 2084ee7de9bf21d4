#include "meshes/membrane_faces.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace vehd::meshes {
namespace {

using Cell = std::array<int, 4>;
using Face = std::array<int, 3>;

Face sorted(Face face) {
  std::sort(face.begin(), face.end());
  return face;
}

Face face_opposite(const Cell& cell, int vertex) {
  Face face{};
  for (int k = 0, n = 0; k < 4; ++k) {
    if (k != vertex) face[n++] = cell[k];
  }
  return sorted(face);
}

bool contains(const Cell& cell, int vertex) { return std::find(cell.begin(), cell.end(), vertex) != cell.end(); }

Cell with_replaced(Cell cell, int vertex, int by) {
  std::replace(cell.begin(), cell.end(), vertex, by);
  return cell;
}

/// Six times the volume over the cube of the root mean square edge length: smooth, and small if the cell is flat.
double regularity(const std::array<Point, 4>& x) {
  Matrix3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x[k + 1] - x[0];
  double squares = 0.0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) squares += (x[i] - x[j]).squaredNorm();
  }
  return edges.determinant() / std::pow(squares / 6.0, 1.5);
}

/// The two vertices of the edge to split, if the cell has two membrane faces: the edge opposite to their common one.
std::optional<std::array<int, 2>> edge_to_cut(const Cell& cell, const std::set<Face>& membrane) {
  std::vector<int> opposite;
  for (int k = 0; k < 4; ++k) {
    // The faces opposite to vertices k and l share the edge of the other two; k and l span the opposite edge.
    if (membrane.contains(face_opposite(cell, k))) opposite.push_back(cell[k]);
  }
  if (opposite.size() < 2) return std::nullopt;
  return std::array<int, 2>{opposite[0], opposite[1]};
}

/// Splits one edge by a vertex on the line from its midpoint through the centre of the cells around it, at the one of
/// several positions that is best for the flattest new cell.
void cut_edge(const std::array<int, 2>& edge, std::vector<Cell>& cells, std::vector<Point>& vertices) {
  std::vector<Cell> ring;
  std::erase_if(cells, [&](const Cell& cell) {
    if (!contains(cell, edge[0]) || !contains(cell, edge[1])) return false;
    ring.push_back(cell);
    return true;
  });
  const int fresh = static_cast<int>(vertices.size());
  std::vector<Cell> halves;
  std::set<int> around;
  for (const Cell& cell : ring) {
    for (const int end : edge) halves.push_back(with_replaced(cell, end, fresh));
    around.insert(cell.begin(), cell.end());
  }
  Point centre = Point::Zero();
  for (const int v : around) centre += vertices[v] / double(around.size());
  const Point middle = 0.5 * (vertices[edge[0]] + vertices[edge[1]]);
  vertices.push_back(middle);
  Point best = middle;
  double best_value = -std::numeric_limits<double>::max();
  constexpr int kTrials = 16;
  for (int trial = 0; trial <= kTrials; ++trial) {
    vertices[fresh] = middle + (2.0 * trial / kTrials) * (centre - middle);
    double value = std::numeric_limits<double>::max();
    for (const Cell& c : halves) {
      value = std::min(value, regularity({vertices[c[0]], vertices[c[1]], vertices[c[2]], vertices[c[3]]}));
    }
    if (value <= best_value) continue;
    best_value = value;
    best = vertices[fresh];
  }
  vertices[fresh] = best;
  cells.insert(cells.end(), halves.begin(), halves.end());
}

void separate(std::vector<Cell>& cells, std::vector<Point>& vertices, const std::set<Face>& membrane) {
  // A split creates no cell with two membrane faces: each half loses one, and no new face is on the membrane.
  for (std::size_t i = 0; i < cells.size();) {
    const auto edge = edge_to_cut(cells[i], membrane);
    if (!edge) {
      ++i;
      continue;
    }
    cut_edge(*edge, cells, vertices);
    i = 0;
  }
}

}  // namespace

void separate_membrane_faces(FilledVolumes& volumes, const std::vector<std::array<int, 3>>& triangles) {
  std::set<Face> membrane;
  for (const Face& face : triangles) membrane.insert(sorted(face));
  separate(volumes.inside, volumes.vertices, membrane);
  separate(volumes.shell, volumes.vertices, membrane);
}

}  // namespace vehd::meshes
