#include "bie/potentials/smooth_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/potentials/few_nodes.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

namespace {

/// Square root of the larger eigenvalue of the metric: the largest length of a unit angle.
Vector largest_stretch(const Matrix& u, const Matrix& v) {
  const Eigen::ArrayXd e = u.rowwise().squaredNorm();
  const Eigen::ArrayXd g = v.rowwise().squaredNorm();
  const Eigen::ArrayXd f = u.cwiseProduct(v).rowwise().sum();
  return (0.5 * (e + g) + (0.25 * (e - g).square() + f.square()).sqrt()).sqrt();
}

void put_columns(const LayerFields& fields, const SphereDerivatives& f, Matrix& nodes) {
  const NodeColumns& columns = fields.columns;
  nodes.resize(f.value.rows(), columns.count);
  nodes.middleCols(columns.position, 3) = f.value.leftCols(3);
  nodes.middleCols(columns.tangent_1, 3) = f.d1.leftCols(3);
  nodes.middleCols(columns.tangent_2, 3) = f.d2.leftCols(3);
  if (columns.single >= 0) nodes.col(columns.single) = f.value.col(fields.single);
  if (columns.double_layer >= 0) nodes.col(columns.double_layer) = f.value.col(fields.double_layer);
  if (columns.double_1 >= 0) {
    nodes.col(columns.double_1) = f.d1.col(fields.double_layer);
    nodes.col(columns.double_2) = f.d2.col(fields.double_layer);
  }
  if (columns.stokes >= 0) nodes.middleCols(columns.stokes, 3) = f.value.middleCols(fields.stokes, 3);
  if (columns.stokes_double >= 0) {
    nodes.middleCols(columns.stokes_double, 3) = f.value.middleCols(fields.stokes_double, 3);
  }
}

}  // namespace

SmoothGrid make_smooth_grid(const LayerFields& fields, int grid_order) {
  return make_smooth_grid(fields, SphereTransform(order_of(fields.coefficients.rows()), make_grid(grid_order)));
}

SmoothGrid make_smooth_grid(const LayerFields& fields, const SphereTransform& transform) {
  const SphereDerivatives f = transform.synthesize_gradient(fields.coefficients);
  const SphereGrid& grid = transform.grid();
  SmoothGrid smooth;
  put_columns(fields, f, smooth.nodes);
  weigh_densities(fields.columns, smooth.n_nodes(), smooth.n_nodes(), smooth.nodes.data());
  smooth.spacing = std::numbers::pi / grid.order * largest_stretch(f.d1.leftCols(3), f.d2.leftCols(3));
  smooth.weight.resize(grid.n_points());
  smooth.directions.resize(grid.n_points(), 3);
  smooth.area_vectors.resize(grid.n_points(), 3);
  for (int j = 0; j < grid.n_theta; ++j) {
    const double sine = std::sin(grid.theta[j]);
    for (int k = 0; k < grid.n_phi; ++k) {
      const Index i = Index{j} * grid.n_phi + k;
      smooth.weight[i] = grid.weight[j];
      smooth.directions.row(i) << sine * std::cos(grid.phi[k]), sine * std::sin(grid.phi[k]), std::cos(grid.theta[j]);
      const Vector3 u = f.d1.row(i).head<3>().transpose();
      const Vector3 v = f.d2.row(i).head<3>().transpose();
      smooth.area_vectors.row(i) = u.cross(v).transpose();
    }
  }
  return smooth;
}

LayersAt smooth_sums(const SmoothGrid& grid, const NodeColumns& columns, const Vector3& target) {
  LayersAt sums;
  add_layer_sums(columns, {grid.nodes.data(), grid.n_nodes(), grid.n_nodes(), grid.weight.data()}, target, sums);
  return sums;
}

double mean_radius(const SmoothGrid& grid) {
  return std::sqrt(grid.area_vectors.rowwise().norm().dot(grid.weight) / (4.0 * std::numbers::pi));
}

NearestNodes nearest_nodes(const SmoothGrid& grid, const Vector3& target) {
  constexpr int kPosition = NodeColumns{}.position;
  const Vector squared_distance =
      (grid.nodes.middleCols<3>(kPosition).rowwise() - target.transpose()).rowwise().squaredNorm();
  NearestNodes nearest;
  nearest.distance = std::sqrt(squared_distance.minCoeff(&nearest.first));
  const double reach = nearest.distance + grid.spacing[nearest.first];
  double least_opposite = reach * reach;
  for (Index i = 0; i < grid.n_nodes(); ++i) {
    if (squared_distance[i] >= least_opposite) continue;
    if (grid.area_vectors.row(i).dot(grid.area_vectors.row(nearest.first)) >= 0.0) continue;
    least_opposite = squared_distance[i];
    nearest.opposite = i;
    nearest.opposite_counts = true;
  }
  return nearest;
}

Vector least_weighted_squares(const SmoothGrid& grid, const Vector& weights, const Matrix& x) {
  constexpr Index kTargets = 4;  // targets that share the reading of a node
  const double *px = grid.nodes.col(0).data(), *py = grid.nodes.col(1).data(), *pz = grid.nodes.col(2).data();
  const Index n = weights.size();
  Vector result(x.rows());
  for (Index first = 0; first < x.rows(); first += kTargets) {
    // If fewer are left, the last one is repeated.
    const auto target = [&](Index t) { return std::min(first + t, x.rows() - 1); };
    Few least[kTargets];
    std::fill_n(least, kTargets, std::numeric_limits<double>::max() - Few{});
    for (Index next = 0; next < n; next += kTogether) {
      const Index i = std::min(next, n - kTogether);
      const Few weight = few(weights.data() + i);
#pragma GCC unroll 4
      for (Index t = 0; t < kTargets; ++t) {
        const Few dx = few(px + i) - x(target(t), 0), dy = few(py + i) - x(target(t), 1),
                  dz = few(pz + i) - x(target(t), 2);
        const Few square = (dx * dx + dy * dy + dz * dz) * weight;
        least[t] = square < least[t] ? square : least[t];
      }
    }
    for (Index t = 0; t < kTargets; ++t) {
      double smallest = least[t][0];
      for (Index k = 1; k < kTogether; ++k) smallest = std::min(smallest, least[t][k]);
      result[target(t)] = smallest;
    }
  }
  return result;
}

}  // namespace vehd
