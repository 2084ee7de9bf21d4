#include "fem_check/membrane_trace.hpp"

#include "meshes/gauss_rule.hpp"

namespace vehd::fem_check {

namespace {

/// Tensor products of Lagrange polynomials at a point of the unit square, first coordinate fastest.
Vector lagrange(const std::vector<double>& nodes, const Eigen::Vector2d& point) {
  const Eigen::MatrixXd along_edges = meshes::NodalPolynomials(nodes, {point[0], point[1]}).value;
  const Eigen::MatrixXd product = along_edges.row(0).transpose() * along_edges.row(1);
  return Eigen::Map<const Vector>(product.data(), product.size());
}

SurfacePoints gauss_points(const Space& space, int per_edge) {
  const dealii::QGauss<1> gauss(static_cast<unsigned>(per_edge));
  std::vector<double> nodes;
  for (const auto& point : gauss.get_points()) nodes.push_back(point[0]);
  return tensor_points(space, nodes, gauss.get_weights());
}

/// First lattice point at each node, in the order of the pairs.
SurfacePoints first_at_each_node(const SurfacePoints& lattice, const SheetPairs& pairs) {
  std::vector<Eigen::Index> kept;
  Eigen::Index point = 0;
  for (const std::vector<int>& face : pairs.of_face) {
    for (const int pair : face) {
      if (pair == static_cast<int>(kept.size())) kept.push_back(point);
      ++point;
    }
  }
  return lattice.picked(kept);
}

/// Values of the trace functions of a face at its points of a rule: [points x nodes].
Eigen::MatrixXd face_values(const SurfacePoints& rule, Eigen::Index per_face, const std::vector<double>& nodes) {
  Eigen::MatrixXd values(per_face, static_cast<Eigen::Index>(nodes.size() * nodes.size()));
  for (Eigen::Index q = 0; q < per_face; ++q) {
    values.row(q) = lagrange(nodes, rule.face_coordinates.col(q)).transpose();
  }
  return values;
}

}  // namespace

Eigen::SparseMatrix<double> membrane_mass(const SurfacePoints& rule, const SheetPairs& pairs, int degree) {
  const Eigen::Index per_face = rule.size() / static_cast<Eigen::Index>(pairs.of_face.size());
  const Eigen::MatrixXd values = face_values(rule, per_face, edge_nodes(static_cast<unsigned>(degree)));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t f = 0; f < pairs.of_face.size(); ++f) {
    const std::vector<int>& of_face = pairs.of_face[f];
    const auto weights = rule.weight.segment(static_cast<Eigen::Index>(f) * per_face, per_face);
    const Eigen::MatrixXd local = values.transpose() * weights.asDiagonal() * values;
    for (std::size_t b = 0; b < of_face.size(); ++b) {
      for (std::size_t a = 0; a < of_face.size(); ++a) entries.emplace_back(of_face[a], of_face[b], local(a, b));
    }
  }
  const auto n = static_cast<Eigen::Index>(pairs.pairs.size());
  Eigen::SparseMatrix<double> mass(n, n);
  mass.setFromTriplets(entries.begin(), entries.end());
  return mass;
}

MembraneTrace::MembraneTrace(const Space& space, int points_per_edge)
    : pairs_(sheet_pairs(space, space.dofs)),
      points_per_edge_(points_per_edge),
      rule_(gauss_points(space, points_per_edge)),
      edge_nodes_(edge_nodes(space.element.degree)) {
  nodes_ = first_at_each_node(tensor_points(space, edge_nodes_, {}), pairs_);
  const Eigen::Index per_face = rule_.size() / static_cast<Eigen::Index>(pairs_.of_face.size());
  shape_ = face_values(rule_, per_face, edge_nodes_);
  mass_.compute(membrane_mass(rule_, pairs_, static_cast<int>(space.element.degree)));
  if (mass_.info() != Eigen::Success) throw SolveError("the mass matrix of the membrane is not positive definite");
}

Vector MembraneTrace::integrate(const Vector& f) const {
  Vector result = Vector::Zero(size());
  for (std::size_t face = 0; face < pairs_.of_face.size(); ++face) {
    const Eigen::Index begin = static_cast<Eigen::Index>(face) * shape_.rows();
    const Vector local =
        shape_.transpose() * weights(static_cast<int>(face)).cwiseProduct(f.segment(begin, shape_.rows()));
    for (std::size_t a = 0; a < pairs_.of_face[face].size(); ++a) result[pairs_.of_face[face][a]] += local[a];
  }
  return result;
}

Vector MembraneTrace::project(const Vector& functional) const { return mass_.solve(functional); }

Vector MembraneTrace::evaluate(const Vector& nodal, const SurfacePoints& points) const {
  Vector result(points.size());
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const Vector shape = lagrange(edge_nodes_, points.face_coordinates.col(i));
    const std::vector<int>& of_face = pairs_.of_face[points.face[i]];
    double sum = 0.0;
    for (std::size_t a = 0; a < of_face.size(); ++a) sum += shape[a] * nodal[of_face[a]];
    result[i] = sum;
  }
  return result;
}

}  // namespace vehd::fem_check
