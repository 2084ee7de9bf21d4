#include "meshes/gauss_rule.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace vehd::meshes {

GaussRule gauss_rule(int n) {
  // Nodes are the eigenvalues of the Jacobi matrix of the Legendre polynomials, weights the squared first components
  // of its eigenvectors (Golub and Welsch).
  Eigen::VectorXd below(n - 1);
  for (int k = 1; k < n; ++k) below[k - 1] = k / std::sqrt(4.0 * k * k - 1.0);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd::Zero(n), below);
  GaussRule rule;
  for (int k = 0; k < n; ++k) {
    rule.node.push_back(solver.eigenvalues()[k]);
    rule.weight.push_back(2.0 * solver.eigenvectors()(0, k) * solver.eigenvectors()(0, k));
  }
  return rule;
}

}  // namespace vehd::meshes
