#include "meshes/distortion.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vehd::meshes {
namespace {

/// w, the weight of the term that penalises changes of volume.
constexpr double kVolumeShare = 0.1;

std::vector<double> on_unit_interval(std::vector<double> nodes) {
  for (double& node : nodes) node = 0.5 + 0.5 * node;
  return nodes;
}

/// ∂ det F/∂F.
Matrix3 cofactors(const Matrix3& f) {
  Matrix3 result;
  for (int k = 0; k < 3; ++k) result.col(k) = f.col((k + 1) % 3).cross(f.col((k + 2) % 3));
  return result;
}

double mean_square(const Matrix3& f) { return f.squaredNorm() / 3.0; }

double energy_density(const Matrix3& f) {
  const double det = f.determinant();
  if (!(det > 0.0)) return std::numeric_limits<double>::infinity();
  return (1.0 - kVolumeShare) * std::pow(mean_square(f), 1.5) / det + kVolumeShare * 0.5 * (det + 1.0 / det);
}

/// ∂ energy_density/∂F.
Matrix3 stress(const Matrix3& f) {
  const double det = f.determinant();
  const double square = mean_square(f);
  const double by_det =
      -(1.0 - kVolumeShare) * std::pow(square, 1.5) / (det * det) + kVolumeShare * 0.5 * (1.0 - 1.0 / (det * det));
  return (1.0 - kVolumeShare) * std::sqrt(square) / det * f + by_det * cofactors(f);
}

/// T with a·T a close to the second derivative of the energy density with respect to row `component` of F along a.
Matrix3 stiffness_density(const Matrix3& f, int component) {
  const double det = f.determinant();
  const double square = mean_square(f);
  const double across = (1.0 - kVolumeShare) * std::sqrt(square) / det;
  const double by_det = 2.0 * (1.0 - kVolumeShare) * std::pow(square, 1.5) / det + kVolumeShare / det;
  const Point slope = cofactors(f).row(component).transpose() / det;
  return across * Matrix3::Identity() + by_det * slope * slope.transpose();
}

}  // namespace

Distortion::Distortion(const Lattice& lattice, const Eigen::Matrix3Xd& undistorted)
    : lattice_(lattice),
      line_(on_unit_interval(lobatto_rule(lattice.degree() + 1).node),
            on_unit_interval(lobatto_rule(lattice.degree() + 3).node)) {
  const GaussRule rule = lobatto_rule(lattice.degree() + 3);
  const Eigen::Index n_line = line_.value.rows();
  const Eigen::Index n_nodes = line_.value.cols();
  const auto split = [](Eigen::Index index, Eigen::Index n) {
    return std::array<Eigen::Index, 3>{index % n, index / n % n, index / n / n};
  };
  slopes_.resize(3 * n_line * n_line * n_line, n_nodes * n_nodes * n_nodes);
  std::vector<double> unit_weight;
  for (Eigen::Index q = 0; q < n_line * n_line * n_line; ++q) {
    const auto [a, b, c] = split(q, n_line);
    unit_weight.push_back(0.125 * rule.weight[a] * rule.weight[b] * rule.weight[c]);
    for (Eigen::Index node = 0; node < slopes_.cols(); ++node) {
      const auto [i, j, k] = split(node, n_nodes);
      slopes_(3 * q, node) = line_.slope(a, i) * line_.value(b, j) * line_.value(c, k);
      slopes_(3 * q + 1, node) = line_.value(a, i) * line_.slope(b, j) * line_.value(c, k);
      slopes_(3 * q + 2, node) = line_.value(a, i) * line_.value(b, j) * line_.slope(c, k);
    }
  }
  for (const Lattice::Cell& cell : lattice.cells()) {
    Matrices inverse;
    std::vector<double> weight;
    for (const Matrix3& slope : unit_derivatives(cell, undistorted)) {
      // Blocks can be left-handed in their own coordinates, hence the magnitude.
      weight.push_back(unit_weight[weight.size()] * std::abs(slope.determinant()));
      inverse.push_back(slope.inverse());
    }
    to_undistorted_.push_back(std::move(inverse));
    weight_.push_back(std::move(weight));
  }
}

Distortion::Matrices Distortion::unit_derivatives(const Lattice::Cell& cell, const Eigen::Matrix3Xd& x) const {
  const Eigen::MatrixXd slopes = slopes_ * x(Eigen::all, cell.nodes).transpose();
  Matrices result;
  for (Eigen::Index q = 0; q < slopes.rows(); q += 3) result.push_back(slopes.middleRows<3>(q).transpose());
  return result;
}

Distortion::Matrices Distortion::deformation(std::size_t cell, const Eigen::Matrix3Xd& x) const {
  Matrices result = unit_derivatives(lattice_.cells()[cell], x);
  for (std::size_t q = 0; q < result.size(); ++q) result[q] = result[q] * to_undistorted_[cell][q];
  return result;
}

double Distortion::energy(const Eigen::Matrix3Xd& x) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < weight_.size(); ++c) {
    const Matrices f = deformation(c, x);
    for (std::size_t q = 0; q < f.size(); ++q) sum += weight_[c][q] * energy_density(f[q]);
    if (!std::isfinite(sum)) return sum;
  }
  return sum;
}

Eigen::Matrix3Xd Distortion::gradient(const Eigen::Matrix3Xd& x) const {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, x.cols());
  Eigen::MatrixX3d stresses(slopes_.rows(), 3);
  for (std::size_t c = 0; c < weight_.size(); ++c) {
    const Matrices f = deformation(c, x);
    for (std::size_t q = 0; q < f.size(); ++q) {
      stresses.middleRows<3>(3 * static_cast<Eigen::Index>(q)) =
          weight_[c][q] * to_undistorted_[c][q] * stress(f[q]).transpose();
    }
    result(Eigen::all, lattice_.cells()[c].nodes) += (slopes_.transpose() * stresses).transpose();
  }
  return result;
}

double Distortion::smallest_determinant(const Eigen::Matrix3Xd& x) const {
  double smallest = std::numeric_limits<double>::max();
  for (std::size_t c = 0; c < weight_.size(); ++c) {
    for (const Matrix3& f : deformation(c, x)) smallest = std::min(smallest, f.determinant());
  }
  return smallest;
}

std::array<Eigen::SparseMatrix<double>, 3> Distortion::stiffness(const Eigen::Matrix3Xd& x) const {
  std::array<std::vector<Eigen::Triplet<double>>, 3> entries;
  Eigen::MatrixXd weighted(slopes_.rows(), slopes_.cols());
  for (std::size_t c = 0; c < weight_.size(); ++c) {
    const std::vector<int>& nodes = lattice_.cells()[c].nodes;
    const Matrices f = deformation(c, x);
    for (int component = 0; component < 3; ++component) {
      for (std::size_t q = 0; q < f.size(); ++q) {
        const Matrix3 tensor = weight_[c][q] * to_undistorted_[c][q] * stiffness_density(f[q], component) *
                               to_undistorted_[c][q].transpose();
        const auto row = 3 * static_cast<Eigen::Index>(q);
        weighted.middleRows<3>(row) = tensor * slopes_.middleRows<3>(row);
      }
      const Eigen::MatrixXd of_cell = slopes_.transpose() * weighted;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (std::size_t j = 0; j < nodes.size(); ++j) {
          entries[component].emplace_back(nodes[i], nodes[j],
                                          of_cell(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
        }
      }
    }
  }
  std::array<Eigen::SparseMatrix<double>, 3> result;
  for (int component = 0; component < 3; ++component) {
    result[component].resize(x.cols(), x.cols());
    result[component].setFromTriplets(entries[component].begin(), entries[component].end());
  }
  return result;
}

}  // namespace vehd::meshes
