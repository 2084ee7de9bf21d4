#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "meshes/blended_map.hpp"
#include "meshes/mesh_quality.hpp"
#include "meshes/oriented_mesh.hpp"
#include "meshes/relaxed_map.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {
namespace {

void require(bool holds, const char* what, double value, const char* accepted) {
  if (!holds) throw std::invalid_argument(fmt::format("block mesh: {} is {}, but must be {}", what, value, accepted));
}

void require_options(const BlockMeshOptions& o) {
  require(o.cells_per_edge >= 1, "cells_per_edge", o.cells_per_edge, "at least 1");
  require(o.blend_layers >= 1, "blend_layers", o.blend_layers, "at least 1");
  require(o.shell_layers >= 1, "shell_layers", o.shell_layers, "at least 1");
  require(o.blend_growth > 0.0, "blend_growth", o.blend_growth, "positive");
  require(o.shell_growth >= 0.0, "shell_growth", o.shell_growth, "positive, or 0 for the automatic value");
  require(o.core_fraction > 0.0 && o.core_fraction < 1.0, "core_fraction", o.core_fraction, "between 0 and 1");
}

}  // namespace

HexMesh::HexMesh(MeshTopology topology, std::shared_ptr<const BlockMap> map)
    : VolumeMesh(std::move(topology), map->centre(), map->outer_radius()), map_(std::move(map)) {
  for (const MeshCell& cell : this->topology().cells) {
    Point middle = Point::Zero();
    for (const int v : cell.vertices) middle += this->topology().vertices[v] / 8.0;
    blocks_.push_back(BlockMap::block_at(middle));
  }
}

Point HexMesh::reference(int cell_index, const Point& unit) const {
  const std::array<double, 8> weights = vertex_functions(CellShape::hexahedron, unit);
  Point result = Point::Zero();
  for (int v = 0; v < 8; ++v) result += weights[v] * topology().vertices[cell(cell_index).vertices[v]];
  return result;
}

Point HexMesh::physical(int cell_index, const Point& unit) const {
  return map_->position(blocks_[cell_index], reference(cell_index, unit));
}

std::vector<Point> HexMesh::physical_points(int cell_index, const std::vector<Point>& units) const {
  Eigen::Matrix3Xd points(3, units.size());
  for (std::size_t i = 0; i < units.size(); ++i) points.col(i) = reference(cell_index, units[i]);
  points = map_->positions(blocks_[cell_index], points);
  std::vector<Point> result(units.size());
  for (std::size_t i = 0; i < units.size(); ++i) result[i] = points.col(i);
  return result;
}

Matrix3 HexMesh::jacobian(int cell_index, const Point& unit) const {
  Matrix3 slope = Matrix3::Zero();
  for (int v = 0; v < 8; ++v) {
    const Point& x = topology().vertices[cell(cell_index).vertices[v]];
    const double sx = (v & 1) ? 1.0 : -1.0;
    const double sy = (v & 2) ? 1.0 : -1.0;
    const double sz = (v & 4) ? 1.0 : -1.0;
    const double wx = (v & 1) ? unit.x() : 1.0 - unit.x();
    const double wy = (v & 2) ? unit.y() : 1.0 - unit.y();
    const double wz = (v & 4) ? unit.z() : 1.0 - unit.z();
    slope.col(0) += sx * wy * wz * x;
    slope.col(1) += wx * sy * wz * x;
    slope.col(2) += wx * wy * sz * x;
  }
  return map_->derivative(blocks_[cell_index], reference(cell_index, unit)) * slope;
}

Point HexMesh::direction(int cell_index, const Point& unit) const {
  if (blocks_[cell_index].layer == Block::Layer::core) {
    throw std::logic_error(fmt::format("cell {} lies in the core: no point of it has a direction", cell_index));
  }
  return map_->direction(blocks_[cell_index], reference(cell_index, unit));
}

double shell_growth(const BlockMeshOptions& options, double radius) {
  return options.shell_growth > 0.0 ? options.shell_growth
                                    : std::pow(options.outer_radius / radius, 1.0 / options.shell_layers);
}

namespace {

HexMesh mesh_of(const FrozenShape& shape, const BlockMeshOptions& options, std::shared_ptr<const BlockMap> map) {
  return {make_block_topology(options, shell_growth(options, shape.radius())), std::move(map)};
}

HexMesh straight_mesh(const FrozenShape& shape, const BlockMeshOptions& options, const BlockAxes& axes) {
  return mesh_of(shape, options,
                 std::make_shared<const BlendedMap>(shape, axes, options.outer_radius, options.core_fraction));
}

MeshQuality quality_of(const HexMesh& mesh, const FrozenShape& shape) {
  constexpr int kGaussPoints = 3;
  return quality(mesh, shape, kGaussPoints);
}

/// Whether a mesh of straight lines has an inverted or too flat element.
bool is_folded(const HexMesh& mesh, const FrozenShape& shape, const BlockMeshOptions& options) {
  return quality_of(mesh, shape).smallest_scaled_jacobian < options.smallest_scaled_jacobian;
}

}  // namespace

bool cells_have_to_be_relaxed(const FrozenShape& shape, const BlockMeshOptions& options) {
  require_options(options);
  return is_folded(straight_mesh(shape, options, best_axes(shape)), shape, options);
}

HexMesh make_block_mesh(const FrozenShape& shape, const BlockMeshOptions& options) {
  return make_block_mesh(shape, options, best_axes(shape));
}

HexMesh make_block_mesh(const FrozenShape& shape, const BlockMeshOptions& options, const BlockAxes& axes) {
  require_options(options);
  HexMesh straight = straight_mesh(shape, options, axes);
  if (!is_folded(straight, shape, options)) return straight;
  BlockMeshOptions even = options;
  even.cells_per_edge += even.cells_per_edge % 2;  // kinks of the map lie between cells
  const auto blocks = std::make_shared<const RelaxedBlocks>(shape, axes, even);
  HexMesh relaxed = mesh_of(shape, even, std::make_shared<const RelaxedMap>(shape, axes, even.outer_radius, blocks));
  require_quality(quality_of(relaxed, shape), options.smallest_scaled_jacobian);
  return relaxed;
}

}  // namespace vehd::meshes
