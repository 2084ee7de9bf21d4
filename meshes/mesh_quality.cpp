#include "meshes/mesh_quality.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "meshes/gauss_rule.hpp"

namespace vehd::meshes {
namespace {

struct WeightedPoint {
  Point unit;
  double weight;
};

/// Tensor Gauss rule on the cube; on the tetrahedron, the rule of a collapsed cube.
std::vector<WeightedPoint> cell_rule(CellShape shape, int n) {
  const GaussRule rule = gauss_rule(n);
  std::vector<WeightedPoint> result;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const Point u(0.5 + 0.5 * rule.node[i], 0.5 + 0.5 * rule.node[j], 0.5 + 0.5 * rule.node[k]);
        const double weight = 0.125 * rule.weight[i] * rule.weight[j] * rule.weight[k];
        if (shape == CellShape::hexahedron) {
          result.push_back({u, weight});
          continue;
        }
        const double left = 1.0 - u.x();
        const double rest = left * (1.0 - u.y());
        result.push_back({{u.x(), left * u.y(), rest * u.z()}, weight * left * rest});
      }
    }
  }
  return result;
}

struct FacePoint {
  double a, b;  ///< coordinates along the edges from the face's first vertex to its second and third
  double weight;
};

std::vector<FacePoint> face_rule(CellShape shape, int n) {
  const GaussRule rule = gauss_rule(n);
  std::vector<FacePoint> result;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double a = 0.5 + 0.5 * rule.node[i];
      const double b = 0.5 + 0.5 * rule.node[j];
      const double weight = 0.25 * rule.weight[i] * rule.weight[j];
      if (shape == CellShape::hexahedron) {
        result.push_back({a, b, weight});
      } else {
        result.push_back({a, (1.0 - a) * b, weight * (1.0 - a)});
      }
    }
  }
  return result;
}

/// det J over the product of its columns' lengths: 1 for a brick.
double scaled_jacobian_of_hexahedron(const Matrix3& j) {
  return j.determinant() / (j.col(0).norm() * j.col(1).norm() * j.col(2).norm());
}

/// √2 det J over the largest product of the three edges that meet at one vertex: 1 for the regular tetrahedron.
double scaled_jacobian_of_tetrahedron(const Matrix3& j) {
  const double a = j.col(0).norm();
  const double b = j.col(1).norm();
  const double c = j.col(2).norm();
  const double ab = (j.col(1) - j.col(0)).norm();
  const double bc = (j.col(2) - j.col(1)).norm();
  const double ca = (j.col(0) - j.col(2)).norm();
  const double largest = std::max({a * b * c, a * ab * ca, b * ab * bc, c * bc * ca});
  return std::numbers::sqrt2 * j.determinant() / largest;
}

double scaled_jacobian(CellShape shape, const Matrix3& j) {
  return shape == CellShape::hexahedron ? scaled_jacobian_of_hexahedron(j) : scaled_jacobian_of_tetrahedron(j);
}

/// A collapsed edge gives 0/0; comparisons with NaN are false and would skip it.
double worst_if_undefined(double value) { return std::isnan(value) ? -std::numeric_limits<double>::infinity() : value; }

/// Adds the areas of the membrane faces.
void add_areas(const VolumeMesh& mesh, int n_gauss, std::vector<VesicleMeasures>& vesicles) {
  const std::vector<FacePoint> rule = face_rule(mesh.cell_shape(), n_gauss);
  for (const InterfacePair& pair : mesh.interface()) {
    const std::array<int, 4>& corners = face_vertices(mesh.cell_shape(), pair.inside_face);
    const Point origin = unit_vertex(mesh.cell_shape(), corners[0]);
    const Point first = unit_vertex(mesh.cell_shape(), corners[1]) - origin;
    const Point second = unit_vertex(mesh.cell_shape(), corners[2]) - origin;
    double& area = vesicles[mesh.cell(pair.inside_cell).vesicle].area;
    for (const FacePoint& p : rule) {
      const Matrix3 j = mesh.jacobian(pair.inside_cell, origin + p.a * first + p.b * second);
      area += p.weight * (j * first).cross(j * second).norm();
    }
  }
}

}  // namespace

MeshQuality quality(const VolumeMesh& mesh, const FrozenShape& shape, int n_gauss) {
  return quality(mesh, std::vector{shape}, n_gauss);
}

MeshQuality quality(const VolumeMesh& mesh, const std::vector<FrozenShape>& shapes, int n_gauss) {
  const CellShape cell_shape = mesh.cell_shape();
  std::vector<WeightedPoint> points = cell_rule(cell_shape, n_gauss);
  for (int v = 0; v < vertices_per_cell(cell_shape); ++v) points.push_back({unit_vertex(cell_shape, v), 0.0});
  MeshQuality result;
  result.vesicles.resize(shapes.size());
  result.smallest_scaled_jacobian = std::numeric_limits<double>::max();
  double smallest_volume = std::numeric_limits<double>::max();
  double largest_volume = 0.0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    double smallest = std::numeric_limits<double>::max();
    Point where = Point::Zero();
    double volume = 0.0;
    for (const WeightedPoint& p : points) {
      const Matrix3 j = mesh.jacobian(c, p.unit);
      volume += p.weight * j.determinant();
      const double value = worst_if_undefined(scaled_jacobian(cell_shape, j));
      if (value >= smallest) continue;
      smallest = value;
      where = p.unit;
    }
    result.scaled_jacobian.push_back(smallest);
    if (smallest < result.smallest_scaled_jacobian) {
      result.smallest_scaled_jacobian = smallest;
      result.worst_cell = c;
      result.worst_region = mesh.cell(c).region;
      result.worst_position = mesh.physical(c, where);
    }
    if (mesh.cell(c).region == Region::inside) result.vesicles[mesh.cell(c).vesicle].volume += volume;
    smallest_volume = std::min(smallest_volume, volume);
    largest_volume = std::max(largest_volume, volume);
  }
  result.smallest_size = std::cbrt(smallest_volume);
  result.largest_size = std::cbrt(largest_volume);
  add_areas(mesh, n_gauss, result.vesicles);
  double volume_of_shapes = 0.0, area_of_shapes = 0.0;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    VesicleMeasures& vesicle = result.vesicles[k];
    vesicle.volume_error = vesicle.volume / shapes[k].volume() - 1.0;
    vesicle.area_error = vesicle.area / shapes[k].area() - 1.0;
    result.volume_inside += vesicle.volume;
    result.area += vesicle.area;
    volume_of_shapes += shapes[k].volume();
    area_of_shapes += shapes[k].area();
  }
  result.volume_error = result.volume_inside / volume_of_shapes - 1.0;
  result.area_error = result.area / area_of_shapes - 1.0;
  return result;
}

void require_quality(const MeshQuality& quality, double smallest_scaled_jacobian) {
  const double value = quality.smallest_scaled_jacobian;
  if (value >= smallest_scaled_jacobian) return;
  const Point& x = quality.worst_position;
  throw MeshError(fmt::format(
      "element {} {} the membrane is {}: scaled Jacobian {:.3g} at ({:.6g}, {:.6g}, {:.6g}), at least {:.3g} is needed",
      quality.worst_cell, quality.worst_region == Region::inside ? "inside" : "outside",
      value > 0.0 ? "too flat" : "inverted", value, x.x(), x.y(), x.z(), smallest_scaled_jacobian));
}

}  // namespace vehd::meshes
