#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "meshes/volume_mesh.hpp"

/// Requirements on every mesh of either family, each as a number or count that a test compares.
namespace vehd::meshes::testing {

/// Random weights of a face's vertices; bilinear on a quadrilateral.
class FacePoints {
 public:
  std::array<double, 4> next(CellShape shape) {
    const double a = uniform_(random_);
    const double b = uniform_(random_);
    if (shape == CellShape::hexahedron) return {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
    return {1.0 - a, a * (1.0 - b), a * b, 0.0};
  }

 private:
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

/// Point of a face, given weights of vertices of the mesh.
inline Point unit_from_vertices(const VolumeMesh& mesh, int cell, const std::map<int, double>& weight_of_vertex) {
  Point unit = Point::Zero();
  for (int v = 0; v < vertices_per_cell(mesh.cell_shape()); ++v) {
    const auto weight = weight_of_vertex.find(mesh.cell(cell).vertices[v]);
    if (weight != weight_of_vertex.end()) unit += weight->second * unit_vertex(mesh.cell_shape(), v);
  }
  return unit;
}

struct FaceCounts {
  int shared = 0;            ///< by two cells of one region
  int membrane = 0;          ///< one region, marked as membrane
  int outer = 0;             ///< one cell, marked as outer sphere
  int wall = 0;              ///< one cell, marked as wall
  int wrong = 0;             ///< anything else
  double largest_gap = 0.0;  ///< between the two images of random points of shared faces
};

/// Counts the faces of a split mesh by kind.
inline FaceCounts count_faces(const VolumeMesh& mesh) {
  struct Place {
    int cell;
    int face;
  };
  std::map<std::vector<int>, std::vector<Place>> places;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    for (int f = 0; f < faces_per_cell(mesh.cell_shape()); ++f) {
      std::vector<int> key;
      for (const int v : face_vertices(mesh.cell_shape(), f)) {
        if (v >= 0) key.push_back(mesh.cell(c).vertices[v]);
      }
      std::sort(key.begin(), key.end());
      places[key].push_back({c, f});
    }
  }
  FaceCounts counts;
  FacePoints points;
  for (const auto& [key, at] : places) {
    const FaceKind kind = mesh.cell(at[0].cell).faces[at[0].face];
    if (at.size() == 1 && kind == FaceKind::membrane) {
      ++counts.membrane;
    } else if (at.size() == 1 && kind == FaceKind::outer_sphere && mesh.cell(at[0].cell).region == Region::outside) {
      ++counts.outer;
    } else if (at.size() == 1 && kind == FaceKind::wall && mesh.cell(at[0].cell).region == Region::outside) {
      ++counts.wall;
    } else if (at.size() == 2 && kind == FaceKind::interior) {
      ++counts.shared;
      const std::array<double, 4> weights = points.next(mesh.cell_shape());
      std::map<int, double> weight_of_vertex;
      for (std::size_t k = 0; k < key.size(); ++k) weight_of_vertex[key[k]] = weights[k];
      if (mesh.cell_shape() == CellShape::hexahedron) {
        // Bilinear weights belong to the face's own vertex order.
        const auto& corners = face_vertices(mesh.cell_shape(), at[0].face);
        for (int k = 0; k < 4; ++k) weight_of_vertex[mesh.cell(at[0].cell).vertices[corners[k]]] = weights[k];
      }
      const Point here = mesh.physical(at[0].cell, unit_from_vertices(mesh, at[0].cell, weight_of_vertex));
      const Point there = mesh.physical(at[1].cell, unit_from_vertices(mesh, at[1].cell, weight_of_vertex));
      counts.largest_gap = std::max(counts.largest_gap, (here - there).norm());
    } else {
      ++counts.wrong;
    }
  }
  return counts;
}

/// Calls visit(pair, inside unit point) at a few random points of every membrane face.
template <typename Visit>
void for_each_membrane_point(const VolumeMesh& mesh, const Visit& visit) {
  FacePoints points;
  for (const InterfacePair& pair : mesh.interface()) {
    const auto& corners = face_vertices(mesh.cell_shape(), pair.inside_face);
    for (int repeat = 0; repeat < 3; ++repeat) {
      const std::array<double, 4> weights = points.next(mesh.cell_shape());
      Point unit = Point::Zero();
      for (int k = 0; k < 4 && corners[k] >= 0; ++k) {
        unit += weights[k] * unit_vertex(mesh.cell_shape(), corners[k]);
      }
      visit(pair, unit);
    }
  }
}

struct SheetGaps {
  double position = 0.0;   ///< between the two sheets at one point of γ
  double direction = 0.0;  ///< the same for r̂
  double off_shape = 0.0;  ///< from x(r̂)
};

inline SheetGaps sheet_gaps(const VolumeMesh& mesh, const FrozenShape& shape) {
  SheetGaps gaps;
  for_each_membrane_point(mesh, [&](const InterfacePair& pair, const Point& inside) {
    const Point outside = mesh.across(pair, inside);
    const Point x = mesh.physical(pair.inside_cell, inside);
    const Point r = mesh.direction(pair.inside_cell, inside);
    gaps.position = std::max(gaps.position, (x - mesh.physical(pair.outside_cell, outside)).norm());
    gaps.direction = std::max(gaps.direction, (r - mesh.direction(pair.outside_cell, outside)).norm());
    gaps.off_shape = std::max(gaps.off_shape, (x - shape.position(r)).norm());
  });
  return gaps;
}

/// Largest distance of the vertices of membrane faces from x(r̂).
inline double vertices_off_shape(const VolumeMesh& mesh, const FrozenShape& shape) {
  double largest = 0.0;
  for (const InterfacePair& pair : mesh.interface()) {
    for (const int v : face_vertices(mesh.cell_shape(), pair.inside_face)) {
      if (v < 0) continue;
      const Point unit = unit_vertex(mesh.cell_shape(), v);
      const Point x = shape.position(mesh.direction(pair.inside_cell, unit));
      largest = std::max(largest, (x - mesh.physical(pair.inside_cell, unit)).norm());
    }
  }
  return largest;
}

/// Largest | |x − centre| − R | over vertices of outer faces.
inline double off_outer_sphere(const VolumeMesh& mesh) {
  double largest = 0.0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    for (int f = 0; f < faces_per_cell(mesh.cell_shape()); ++f) {
      if (mesh.cell(c).faces[f] != FaceKind::outer_sphere) continue;
      for (const int v : face_vertices(mesh.cell_shape(), f)) {
        if (v < 0) continue;
        const Point x = mesh.physical(c, unit_vertex(mesh.cell_shape(), v));
        largest = std::max(largest, std::abs((x - mesh.centre()).norm() - mesh.outer_radius()));
      }
    }
  }
  return largest;
}

/// Number of vertices that cells of both regions use.
inline int vertices_of_both_regions(const VolumeMesh& mesh) {
  std::array<std::set<int>, 2> used;
  for (const MeshCell& cell : mesh.topology().cells) {
    for (int v = 0; v < vertices_per_cell(mesh.cell_shape()); ++v) {
      used[static_cast<int>(cell.region)].insert(cell.vertices[v]);
    }
  }
  return static_cast<int>(std::count_if(used[0].begin(), used[0].end(), [&](int v) { return used[1].contains(v); }));
}

/// Largest distance between the two vertices at one point of γ.
inline double vertex_pair_gap(const VolumeMesh& mesh) {
  const std::vector<Point> positions = mesh.vertex_positions();
  double largest = 0.0;
  for (const auto& [in, out] : mesh.topology().interface_vertices) {
    largest = std::max(largest, (positions[in] - positions[out]).norm());
  }
  return largest;
}

/// Largest difference of jacobian() from central differences of physical(), over one point of some cells.
inline double jacobian_error(const VolumeMesh& mesh) {
  constexpr double kStep = 1e-5;
  const Point unit(0.21, 0.34, 0.17);
  double largest = 0.0;
  for (int c = 0; c < mesh.n_cells(); c += 7) {
    const Matrix3 exact = mesh.jacobian(c, unit);
    for (int k = 0; k < 3; ++k) {
      const Point step = kStep * Point::Unit(k);
      const Point slope = (mesh.physical(c, unit + step) - mesh.physical(c, unit - step)) / (2.0 * kStep);
      largest = std::max(largest, (slope - exact.col(k)).norm() / exact.norm());
    }
  }
  return largest;
}

/// Largest difference between points evaluated in a batch and one by one.
inline double batch_gap(const VolumeMesh& mesh) {
  const std::vector<Point> units{{0.1, 0.2, 0.3}, {0.0, 0.0, 1.0}, {0.25, 0.25, 0.25}, {0.6, 0.1, 0.2}};
  double largest = 0.0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const std::vector<Point> together = mesh.physical_points(c, units);
    for (std::size_t i = 0; i < units.size(); ++i) {
      largest = std::max(largest, (together[i] - mesh.physical(c, units[i])).norm());
    }
  }
  return largest;
}

/// Whether two meshes are identical bit by bit.
inline bool identical(const VolumeMesh& a, const VolumeMesh& b) {
  if (a.n_cells() != b.n_cells() || a.topology().vertices != b.topology().vertices) return false;
  for (int c = 0; c < a.n_cells(); ++c) {
    if (a.cell(c).vertices != b.cell(c).vertices) return false;
  }
  return a.vertex_positions() == b.vertex_positions();
}

}  // namespace vehd::meshes::testing
