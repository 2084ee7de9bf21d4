#include "meshes/gauss_rule.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace vehd::meshes {
namespace {

/// Roots, ascending, of the orthogonal polynomial whose Jacobi matrix has a zero diagonal and this subdiagonal, and the
/// squared first components of the eigenvectors: nodes and normalised weights of a rule (Golub and Welsch).
GaussRule rule_of(const Eigen::VectorXd& below) {
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd::Zero(below.size() + 1), below);
  GaussRule rule;
  for (Eigen::Index k = 0; k <= below.size(); ++k) {
    rule.node.push_back(solver.eigenvalues()[k]);
    rule.weight.push_back(solver.eigenvectors()(0, k) * solver.eigenvectors()(0, k));
  }
  return rule;
}

}  // namespace

GaussRule gauss_rule(int n) {
  Eigen::VectorXd below(n - 1);
  for (int k = 1; k < n; ++k) below[k - 1] = k / std::sqrt(4.0 * k * k - 1.0);
  GaussRule rule = rule_of(below);
  for (double& weight : rule.weight) weight *= 2.0;
  return rule;
}

GaussRule lobatto_rule(int n) {
  GaussRule rule;
  if (n > 2) {
    // The inner nodes are the roots of P'_{n−1}, a Jacobi polynomial with weight 1 − x².
    Eigen::VectorXd below(n - 3);
    for (int k = 1; k < n - 2; ++k) below[k - 1] = std::sqrt(k * (k + 2.0) / ((2.0 * k + 1.0) * (2.0 * k + 3.0)));
    rule.node = rule_of(below).node;
  }
  rule.node.insert(rule.node.begin(), -1.0);
  rule.node.push_back(1.0);
  for (const double x : rule.node) {
    const double p = std::legendre(static_cast<unsigned>(n - 1), x);
    rule.weight.push_back(2.0 / (n * (n - 1) * p * p));
  }
  return rule;
}

NodalPolynomials::NodalPolynomials(const std::vector<double>& nodes, const std::vector<double>& points)
    : value(points.size(), nodes.size()), slope(points.size(), nodes.size()) {
  for (std::size_t q = 0; q < points.size(); ++q) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      double product = 1.0;
      double derivative = 0.0;
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        if (k == i) continue;
        const double width = nodes[i] - nodes[k];
        derivative = (derivative * (points[q] - nodes[k]) + product) / width;
        product *= (points[q] - nodes[k]) / width;
      }
      value(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(i)) = product;
      slope(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(i)) = derivative;
    }
  }
}

}  // namespace vehd::meshes
