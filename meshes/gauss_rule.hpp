#pragma once

#include <Eigen/Core>
#include <vector>

namespace vehd::meshes {

/// A rule of quadrature on [−1, 1]; nodes ascend.
struct GaussRule {
  std::vector<double> node;
  std::vector<double> weight;
};

/// Gauss–Legendre rule with n points, exact to degree 2n − 1.
GaussRule gauss_rule(int n);

/// Gauss–Lobatto rule with n ≥ 2 points, both ends among them, exact to degree 2n − 3.
GaussRule lobatto_rule(int n);

/// Polynomials that are 1 at one node and 0 at the others, at some points: [n_points x n_nodes].
struct NodalPolynomials {
  Eigen::MatrixXd value;
  Eigen::MatrixXd slope;

  NodalPolynomials(const std::vector<double>& nodes, const std::vector<double>& points);
};

}  // namespace vehd::meshes
