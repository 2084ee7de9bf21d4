#include "meshes/box_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "meshes/breaks.hpp"
#include "meshes/mesh_quality.hpp"

namespace vehd::meshes {
namespace {

using BoxLayer = BoxBlock::Layer;

class BoxMeshBuilder {
 public:
  /// @param n_vesicles  1 for a mesh beside a wall
  BoxMeshBuilder(const BoxMeshOptions& options, const BoxMap& map, int n_vesicles)
      : n_(options.cells_per_edge), n_vesicles_(n_vesicles), map_(map), across_(even_breaks(n_)) {
    topology.shape = CellShape::hexahedron;
    int level = 0;
    for (const auto& [layer, borders] :
         {std::pair{BoxLayer::blend, layer_breaks(options.blend_layers, 1.0)},
          std::pair{BoxLayer::box, layer_breaks(options.box_layers, options.box_growth)},
          std::pair{BoxLayer::outer, layer_breaks(options.outer_layers, options.outer_growth)}}) {
      const int first_level = level;
      if (layer == BoxLayer::outer) first_outer_level_ = level;
      level += static_cast<int>(borders.size()) - 1;
      shells_.push_back({layer, first_level, borders});
    }
  }

  MeshTopology topology;
  std::vector<BoxMesh::CellPlace> places;

  void build() {
    for (int vesicle = 0; vesicle < n_vesicles_; ++vesicle) {
      add_core(vesicle);
      for (const Shell& shell : shells_) {
        for (int axis = 0; axis < 3; ++axis) {
          for (const double sign : {-1.0, 1.0}) {
            // Nothing lies beyond the face in which the boxes meet, or in which one meets the wall.
            if (shell.layer == BoxLayer::outer && faces_plane(vesicle, axis, sign)) continue;
            add_shell({shell.layer, vesicle, axis, sign}, shell);
          }
        }
      }
    }
    find_interface(topology);
    split_interface(topology);
  }

 private:
  /// Layers of one kind of block; levels number the boundaries between layers from the core outwards.
  struct Shell {
    BoxLayer layer;
    int first_level;
    std::vector<double> borders;
  };
  static bool faces_plane(int vesicle, int axis, double sign) { return axis == 2 && (sign > 0.0) == (vesicle == 0); }
  /// Identifies a vertex in all blocks that share it: vesicle, level and position on the cube, from −n to n.
  using Key = std::array<int, 5>;

  void add_core(int vesicle) {
    for (int k = 0; k < n_; ++k) {
      for (int j = 0; j < n_; ++j) {
        for (int i = 0; i < n_; ++i) {
          add_cell({BoxLayer::core, vesicle, 0, 1.0}, {i, j, k}, across_, [&](const std::array<int, 3>& corner) {
            return Key{vesicle, 0, 2 * corner[0] - n_, 2 * corner[1] - n_, 2 * corner[2] - n_};
          });
        }
      }
    }
  }

  void add_shell(const BoxBlock& block, const Shell& shell) {
    const int first = (block.axis + (block.sign > 0.0 ? 1 : 2)) % 3, second = 3 - block.axis - first;
    const auto key = [&](const std::array<int, 3>& corner) {
      Key result{block.vesicle, shell.first_level + corner[2], 0, 0, 0};
      result[2 + block.axis] = block.sign > 0.0 ? n_ : -n_;
      result[2 + first] = 2 * corner[0] - n_;
      result[2 + second] = 2 * corner[1] - n_;
      // Vertices that both boxes share are assigned to the first vesicle.
      if (result[1] >= first_outer_level_ && block.vesicle == 1 && result[4] == -n_) {
        result[0] = 0;
        result[4] = n_;
      }
      return result;
    };
    const int layers = static_cast<int>(shell.borders.size()) - 1;
    for (int k = 0; k < layers; ++k) {
      for (int j = 0; j < n_; ++j) {
        for (int i = 0; i < n_; ++i) {
          MeshCell& cell = add_cell(block, {i, j, k}, shell.borders, key);
          constexpr int kInnerFace = 4, kOuterFace = 5;
          if (shell.layer == BoxLayer::box && k == 0) cell.faces[kInnerFace] = FaceKind::membrane;
          if (shell.layer == BoxLayer::blend && k == layers - 1) cell.faces[kOuterFace] = FaceKind::membrane;
          if (shell.layer == BoxLayer::outer && k == layers - 1) cell.faces[kOuterFace] = FaceKind::outer_sphere;
          if (n_vesicles_ == 2) continue;
          const bool box_on_wall = shell.layer == BoxLayer::box && faces_plane(0, block.axis, block.sign);
          if (box_on_wall && k == layers - 1) cell.faces[kOuterFace] = FaceKind::wall;
          // Outer blocks meet the wall at the upper end of the coordinate along its normal.
          if (shell.layer != BoxLayer::outer || block.axis == 2) continue;
          if ((first == 2 ? i : j) == n_ - 1) cell.faces[first == 2 ? 1 : 3] = FaceKind::wall;
        }
      }
    }
  }

  template <typename KeyOf>
  MeshCell& add_cell(const BoxBlock& block, const std::array<int, 3>& index, const std::vector<double>& third,
                     const KeyOf& key_of) {
    const auto corner_at = [&](const std::array<int, 3>& corner) {
      return Point(across_[corner[0]], across_[corner[1]], third[corner[2]]);
    };
    MeshCell cell;
    cell.region = block.layer == BoxLayer::core || block.layer == BoxLayer::blend ? Region::inside : Region::outside;
    cell.vesicle = block.vesicle;
    cell.faces.fill(FaceKind::interior);
    for (int v = 0; v < 8; ++v) {
      const std::array<int, 3> corner{index[0] + (v & 1), index[1] + (v >> 1 & 1), index[2] + (v >> 2 & 1)};
      const auto [place, fresh] = numbers_.try_emplace(key_of(corner), static_cast<int>(topology.vertices.size()));
      if (fresh) topology.vertices.push_back(map_.position(block, corner_at(corner)));
      cell.vertices[v] = place->second;
    }
    places.push_back({block, corner_at(index), corner_at({index[0] + 1, index[1] + 1, index[2] + 1})});
    topology.cells.push_back(cell);
    return topology.cells.back();
  }

  int n_, n_vesicles_;
  const BoxMap& map_;
  std::vector<double> across_;
  std::vector<Shell> shells_;
  int first_outer_level_ = 0;
  std::map<Key, int> numbers_;
};

void require_option(bool holds, const char* what, double value, const char* accepted) {
  if (!holds) {
    throw std::invalid_argument(fmt::format("mesh of boxes: {} is {}, but must be {}", what, value, accepted));
  }
}

void require_options(const BoxMeshOptions& o) {
  require_option(o.cells_per_edge >= 1, "cells_per_edge", o.cells_per_edge, "at least 1");
  require_option(o.blend_layers >= 1, "blend_layers", o.blend_layers, "at least 1");
  require_option(o.box_layers >= 1, "box_layers", o.box_layers, "at least 1");
  require_option(o.outer_layers >= 1, "outer_layers", o.outer_layers, "at least 1");
  require_option(o.box_growth > 0.0, "box_growth", o.box_growth, "positive");
  require_option(o.outer_growth > 0.0, "outer_growth", o.outer_growth, "positive");
  require_option(o.boxes.core_fraction > 0.0 && o.boxes.core_fraction < 1.0, "core_fraction", o.boxes.core_fraction,
                 "between 0 and 1");
  require_option(o.boxes.margin > 0.0, "margin", o.boxes.margin, "positive");
}

}  // namespace

BoxMesh::BoxMesh(MeshTopology topology, std::vector<CellPlace> places, std::shared_ptr<const BoxMap> map,
                 double outer_radius, const std::optional<Wall>& wall)
    : VolumeMesh(std::move(topology), map->centre(), outer_radius, wall),
      places_(std::move(places)),
      map_(std::move(map)) {}

Point BoxMesh::in_block(int cell, const Point& unit) const {
  const CellPlace& place = places_[cell];
  return place.low + unit.cwiseProduct(place.high - place.low);
}

Point BoxMesh::physical(int cell, const Point& unit) const {
  return map_->position(places_[cell].block, in_block(cell, unit));
}

std::vector<Point> BoxMesh::physical_points(int cell, const std::vector<Point>& units) const {
  Eigen::Matrix3Xd points(3, units.size());
  for (std::size_t i = 0; i < units.size(); ++i) points.col(i) = in_block(cell, units[i]);
  points = map_->positions(places_[cell].block, points);
  return {points.colwise().begin(), points.colwise().end()};
}

Matrix3 BoxMesh::jacobian(int cell, const Point& unit) const {
  const CellPlace& place = places_[cell];
  return map_->derivative(place.block, in_block(cell, unit)) * (place.high - place.low).asDiagonal();
}

Point BoxMesh::direction(int cell, const Point& unit) const {
  if (places_[cell].block.layer == BoxLayer::core) {
    throw std::logic_error(fmt::format("cell {} lies in a core: no point of it has a direction", cell));
  }
  return map_->direction(places_[cell].block, in_block(cell, unit));
}

namespace {

BoxMesh make_box_mesh(const std::shared_ptr<const BoxMap>& map, const std::vector<FrozenShape>& shapes,
                      const std::optional<Wall>& wall, const BoxMeshOptions& options) {
  BoxMeshBuilder builder(options, *map, static_cast<int>(shapes.size()));
  builder.build();
  BoxMesh mesh(std::move(builder.topology), std::move(builder.places), map, options.boxes.outer_radius, wall);
  constexpr int kGaussPoints = 3;
  require_quality(quality(mesh, shapes, kGaussPoints), options.smallest_scaled_jacobian);
  return mesh;
}

}  // namespace

BoxMesh make_two_vesicle_mesh(const std::array<FrozenShape, 2>& shapes, const BoxMeshOptions& options) {
  require_options(options);
  return make_box_mesh(std::make_shared<const BoxMap>(shapes, options.boxes), {shapes[0], shapes[1]}, {}, options);
}

BoxMesh make_mesh_beside_wall(const FrozenShape& shape, const Wall& wall, const BoxMeshOptions& options) {
  return make_mesh_beside_wall(shape, shape, wall, options);
}

BoxMesh make_mesh_beside_wall(const FrozenShape& shape, const FrozenShape& like, const Wall& wall,
                              const BoxMeshOptions& options) {
  require_options(options);
  return make_box_mesh(std::make_shared<const BoxMap>(shape, like, wall, options.boxes), {shape}, wall, options);
}

}  // namespace vehd::meshes
