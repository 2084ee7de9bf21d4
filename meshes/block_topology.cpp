#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <unordered_map>

#include "meshes/block_map.hpp"
#include "meshes/gmsh_session.hpp"

namespace vehd::meshes {
namespace {

/// Geometry entities of the block mesh; lines and surfaces are created at first use and shared afterwards.
class BlockModel {
 public:
  int point(const Point& x) { return gmsh::model::geo::addPoint(x.x(), x.y(), x.z()); }

  /// Line from a to b with nodes in geometric progression: each interval `growth` times the one before.
  int line(int a, int b, int intervals, double growth = 1.0) {
    if (lines_.contains({b, a})) return -lines_.at({b, a});
    if (const auto known = lines_.find({a, b}); known != lines_.end()) return known->second;
    const int tag = gmsh::model::geo::addLine(a, b);
    gmsh::model::geo::mesh::setTransfiniteCurve(tag, intervals + 1, "Progression", growth);
    lines_[{a, b}] = tag;
    return tag;
  }

  /// Quadrilateral through four points whose lines exist.
  int surface(std::array<int, 4> corners) {
    std::array<int, 4> key = corners;
    std::sort(key.begin(), key.end());
    if (const auto known = surfaces_.find(key); known != surfaces_.end()) return known->second;
    std::vector<int> loop;
    for (int k = 0; k < 4; ++k) loop.push_back(line(corners[k], corners[(k + 1) % 4], 1));
    const int tag = gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop(loop)});
    gmsh::model::geo::mesh::setTransfiniteSurface(tag);
    gmsh::model::geo::mesh::setRecombine(2, tag);
    surfaces_[key] = tag;
    return tag;
  }

  /// Block between two opposite quadrilaterals with corresponding corners in cyclic order.
  int volume(const std::array<int, 4>& bottom, const std::array<int, 4>& top) {
    std::vector<int> shell{surface(bottom), surface(top)};
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      shell.push_back(surface({bottom[k], bottom[next], top[next], top[k]}));
    }
    const int tag = gmsh::model::geo::addVolume({gmsh::model::geo::addSurfaceLoop(shell)});
    gmsh::model::geo::mesh::setTransfiniteVolume(tag);
    return tag;
  }

 private:
  std::map<std::array<int, 2>, int> lines_;
  std::map<std::array<int, 4>, int> surfaces_;
};

/// Corners of a cube face in cyclic order, as numbers 0 … 7 with bit k for coordinate k.
std::array<int, 4> face_corners(int axis, int side) {
  const int first = 1 << ((axis + 1) % 3);
  const int second = 1 << ((axis + 2) % 3);
  const int base = side << axis;
  return {base, base | first, base | first | second, base | second};
}

std::array<int, 4> pick(const std::array<int, 8>& points, const std::array<int, 4>& corners) {
  return {points[corners[0]], points[corners[1]], points[corners[2]], points[corners[3]]};
}

/// Builds the 13 volumes and returns their tags.
std::vector<int> build_blocks(const BlockMeshOptions& options, double shell_growth) {
  BlockModel model;
  std::array<std::array<int, 8>, 3> cubes;
  const std::array<double, 3> half_widths{BlockMap::kCore, BlockMap::kMembrane, BlockMap::kOuter};
  for (int cube = 0; cube < 3; ++cube) {
    for (int corner = 0; corner < 8; ++corner) {
      const Point sign((corner & 1) ? 1.0 : -1.0, (corner & 2) ? 1.0 : -1.0, (corner & 4) ? 1.0 : -1.0);
      cubes[cube][corner] = model.point(half_widths[cube] * sign);
    }
    for (int corner = 0; corner < 8; ++corner) {
      for (const int bit : {1, 2, 4}) {
        if (!(corner & bit)) model.line(cubes[cube][corner], cubes[cube][corner | bit], options.cells_per_edge);
      }
    }
  }
  for (int corner = 0; corner < 8; ++corner) {
    model.line(cubes[0][corner], cubes[1][corner], options.blend_layers, 1.0 / options.blend_growth);
    model.line(cubes[1][corner], cubes[2][corner], options.shell_layers, shell_growth);
  }
  std::vector<int> volumes{model.volume(pick(cubes[0], face_corners(2, 0)), pick(cubes[0], face_corners(2, 1)))};
  for (int layer = 0; layer < 2; ++layer) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) {
        const std::array<int, 4> corners = face_corners(axis, side);
        volumes.push_back(model.volume(pick(cubes[layer], corners), pick(cubes[layer + 1], corners)));
      }
    }
  }
  gmsh::model::geo::synchronize();
  return volumes;
}

/// Coordinates along the edges of a cell, right-handed: X itself in the core, otherwise two coordinates across and the
/// radial one.
Point block_coordinates(const Block& block, const Point& x) {
  if (block.layer == Block::Layer::core) return x;
  const double s = block.sign * x[block.axis];
  const double first = x[(block.axis + 1) % 3] / s;
  const double second = x[(block.axis + 2) % 3] / s;
  return block.sign > 0.0 ? Point(first, second, s) : Point(second, first, s);
}

/// Sorts the vertices lexicographically in the block coordinates; gmsh's order varies.
std::array<int, 8> ordered(const std::vector<Point>& vertices, const std::array<int, 8>& cell, const Block& block) {
  Point middle = Point::Zero();
  for (const int v : cell) middle += block_coordinates(block, vertices[v]) / 8.0;
  std::array<int, 8> result;
  result.fill(-1);
  for (const int v : cell) {
    const Point b = block_coordinates(block, vertices[v]);
    result[(b.x() > middle.x() ? 1 : 0) + (b.y() > middle.y() ? 2 : 0) + (b.z() > middle.z() ? 4 : 0)] = v;
  }
  if (std::count(result.begin(), result.end(), -1) > 0) {
    throw MeshError(fmt::format("the reference mesh has a cell that is no box, at ({:.4g}, {:.4g}, {:.4g})", middle.x(),
                                middle.y(), middle.z()));
  }
  return result;
}

/// Removes the rounding errors of gmsh's nodes on cube faces.
Point snapped(Point x) {
  for (double& value : x) {
    for (const double plane : {BlockMap::kMembrane, BlockMap::kOuter}) {
      if (std::abs(std::abs(value) - plane) < 1e-9) value = std::copysign(plane, value);
    }
  }
  return x;
}

std::array<FaceKind, 6> face_kinds(const std::vector<Point>& vertices, const MeshCell& cell) {
  std::array<FaceKind, 6> result;
  result.fill(FaceKind::interior);
  for (int face = 0; face < 6; ++face) {
    const auto all_at = [&](double s) {
      const auto& corners = face_vertices(CellShape::hexahedron, face);
      return std::all_of(corners.begin(), corners.end(),
                         [&](int v) { return vertices[cell.vertices[v]].cwiseAbs().maxCoeff() == s; });
    };
    if (all_at(BlockMap::kMembrane)) result[face] = FaceKind::membrane;
    if (all_at(BlockMap::kOuter)) result[face] = FaceKind::outer_sphere;
  }
  return result;
}

/// Reads the vertices in the order of gmsh's tags; returns the number of each tag.
std::unordered_map<std::size_t, int> read_vertices(std::vector<Point>& vertices) {
  std::vector<std::size_t> tags;
  std::vector<double> x;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters);
  std::map<std::size_t, Point> sorted;
  for (std::size_t i = 0; i < tags.size(); ++i) sorted[tags[i]] = snapped({x[3 * i], x[3 * i + 1], x[3 * i + 2]});
  std::unordered_map<std::size_t, int> index;
  for (const auto& [tag, position] : sorted) {
    index[tag] = static_cast<int>(vertices.size());
    vertices.push_back(position);
  }
  return index;
}

void read_cells(int volume, const std::unordered_map<std::size_t, int>& index, MeshTopology& topology) {
  constexpr int kHexahedron = 5;  // gmsh's element type
  std::vector<std::size_t> tags;
  std::vector<std::size_t> nodes;
  gmsh::model::mesh::getElementsByType(kHexahedron, tags, nodes, volume);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    MeshCell cell;
    Point middle = Point::Zero();
    for (int k = 0; k < 8; ++k) {
      cell.vertices[k] = index.at(nodes[8 * i + k]);
      middle += topology.vertices[cell.vertices[k]] / 8.0;
    }
    const Block block = BlockMap::block_at(middle);
    cell.region = block.layer == Block::Layer::shell ? Region::outside : Region::inside;
    cell.vertices = ordered(topology.vertices, cell.vertices, block);
    cell.faces = face_kinds(topology.vertices, cell);
    topology.cells.push_back(cell);
  }
}

}  // namespace

MeshTopology make_block_topology(const BlockMeshOptions& options, double shell_growth) {
  const GmshSession session;
  MeshTopology topology;
  topology.shape = CellShape::hexahedron;
  std::vector<int> volumes;
  try {
    volumes = build_blocks(options, shell_growth);
    gmsh::model::mesh::generate(3);
  } catch (...) {
    throw MeshError("gmsh cannot make the reference block mesh: " + gmsh_message());
  }
  const std::unordered_map<std::size_t, int> index = read_vertices(topology.vertices);
  for (const int volume : volumes) read_cells(volume, index, topology);
  const int n = options.cells_per_edge;
  const int expected = n * n * n + 6 * n * n * (options.blend_layers + options.shell_layers);
  if (static_cast<int>(topology.cells.size()) != expected) {
    throw MeshError(
        fmt::format("gmsh made {} hexahedra of the reference block mesh, not {}", topology.cells.size(), expected));
  }
  find_interface(topology);
  split_interface(topology);
  return topology;
}

}  // namespace vehd::meshes
