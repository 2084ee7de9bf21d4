#include "meshes/second_order_mesh.hpp"

#include <stdexcept>

namespace vehd::meshes {
namespace {

using NodeWeights = Eigen::Matrix<double, 27, 1>;

/// Quadratic Lagrange polynomials of the nodes 0, ½, 1.
Point functions_of(double t) { return {(1.0 - t) * (1.0 - 2.0 * t), 4.0 * t * (1.0 - t), t * (2.0 * t - 1.0)}; }
Point slopes_of(double t) { return {4.0 * t - 3.0, 4.0 - 8.0 * t, 4.0 * t - 1.0}; }

NodeWeights products(const Point& x, const Point& y, const Point& z) {
  NodeWeights result;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) result[9 * k + 3 * j + i] = x[i] * y[j] * z[k];
    }
  }
  return result;
}

}  // namespace

SecondOrderMesh::SecondOrderMesh(const VolumeMesh& exact)
    : VolumeMesh(exact.topology(), exact.centre(), exact.outer_radius(), exact.wall()), exact_(exact) {
  if (exact.cell_shape() != CellShape::hexahedron) throw std::invalid_argument("second-order mesh: not of hexahedra");
  std::vector<Point> units;
  for (const double z : {0.0, 0.5, 1.0}) {
    for (const double y : {0.0, 0.5, 1.0}) {
      for (const double x : {0.0, 0.5, 1.0}) units.emplace_back(x, y, z);
    }
  }
  for (int c = 0; c < exact.n_cells(); ++c) {
    const std::vector<Point> points = exact.physical_points(c, units);
    Nodes& nodes = nodes_.emplace_back();
    for (std::size_t i = 0; i < points.size(); ++i) nodes.col(static_cast<Eigen::Index>(i)) = points[i];
  }
}

Point SecondOrderMesh::physical(int cell, const Point& unit) const {
  return nodes_[cell] * products(functions_of(unit.x()), functions_of(unit.y()), functions_of(unit.z()));
}

std::vector<Point> SecondOrderMesh::physical_points(int cell, const std::vector<Point>& units) const {
  std::vector<Point> result;
  result.reserve(units.size());
  for (const Point& unit : units) result.push_back(physical(cell, unit));
  return result;
}

Matrix3 SecondOrderMesh::jacobian(int cell, const Point& unit) const {
  const Point x = functions_of(unit.x()), y = functions_of(unit.y()), z = functions_of(unit.z());
  Matrix3 result;
  result.col(0) = nodes_[cell] * products(slopes_of(unit.x()), y, z);
  result.col(1) = nodes_[cell] * products(x, slopes_of(unit.y()), z);
  result.col(2) = nodes_[cell] * products(x, y, slopes_of(unit.z()));
  return result;
}

}  // namespace vehd::meshes
