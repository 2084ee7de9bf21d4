#pragma once

#include <Eigen/Core>
#include <vector>

namespace vehd::meshes {

/// A quadrature rule on [−1, 1]; nodes ascend.
struct GaussRule {
  std::vector<double> node;
  std::vector<double> weight;
};

/// Gauss–Legendre rule with n points, exact to degree 2n − 1.
GaussRule gauss_rule(int n);

/// Gauss–Lobatto rule with n ≥ 2 points, both ends included, exact to degree 2n − 3.
GaussRule lobatto_rule(int n);

/// Lagrange polynomials of the nodes, and their derivatives, at given points: [n_points x n_nodes].
struct NodalPolynomials {
  Eigen::MatrixXd value;
  Eigen::MatrixXd slope;

  NodalPolynomials(const std::vector<double>& nodes, const std::vector<double>& points);
};

}  // namespace vehd::meshes
