#pragma once

#include "fem_check/space.hpp"

namespace vehd::fem_check {

/// ∫_γ u w dA for the trace functions of elements of a degree, numbered as the pairs.
/// @param rule  Gauss points of γ, the same number on each face
Eigen::SparseMatrix<double> membrane_mass(const SurfacePoints& rule, const SheetPairs& pairs, int degree);

/// Restriction of the scalar element to γ: nodal values (one per pair of coincident nodes), functionals, L2 projection.
class MembraneTrace {
 public:
  MembraneTrace(const Space& space, int points_per_edge);

  [[nodiscard]] const SheetPairs& pairs() const { return pairs_; }
  /// Number of pairs, equal to that of trace functions.
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(pairs_.pairs.size()); }
  /// Positions (and directions) of the nodes, in the order of the pairs.
  [[nodiscard]] const SurfacePoints& nodes() const { return nodes_; }
  /// Gauss points of the rule along an edge of a face.
  [[nodiscard]] int points_per_edge() const { return points_per_edge_; }
  /// Gauss points at which surface fields are evaluated.
  [[nodiscard]] const SurfacePoints& rule() const { return rule_; }
  /// Values of the trace functions of one face at its points of the rule: [points x nodes].
  [[nodiscard]] const Eigen::MatrixXd& shape() const { return shape_; }
  /// Weights of the rule on one face.
  [[nodiscard]] auto weights(int face) const { return rule_.weight.segment(face * shape_.rows(), shape_.rows()); }

  /// ∫_γ f w dA for every trace function w, [size()].
  /// @param f  values at the points of the rule, [rule().size()]
  [[nodiscard]] Vector integrate(const Vector& f) const;
  /// Nodal values, [size()], of the trace function f from ∫_γ f w dA for every w, [size()].
  [[nodiscard]] Vector project(const Vector& functional) const;
  /// Values of a trace function at points of γ, [points.size()].
  /// @param nodal  its nodal values, [size()]
  [[nodiscard]] Vector evaluate(const Vector& nodal, const SurfacePoints& points) const;

 private:
  SheetPairs pairs_;
  int points_per_edge_;
  SurfacePoints nodes_;
  SurfacePoints rule_;
  Eigen::MatrixXd shape_;
  std::vector<double> edge_nodes_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> mass_;
};

}  // namespace vehd::fem_check
