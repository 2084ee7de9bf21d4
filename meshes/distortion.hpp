#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "meshes/gauss_rule.hpp"
#include "meshes/lattice.hpp"

namespace vehd::meshes {

/// How much the cells of a lattice are distorted, as an energy of its nodes x:
///
///   E(x) = ∫ [ (1 − w) (|F|²/3)^{3/2}/det F + w (det F + 1/det F)/2 ] dX,
///
/// F the derivative of x by undistorted places X. The first term is 1 for a similarity and grows with every other
/// change of form, the second keeps volumes; both are infinite where det F is 0. Whatever is no larger than the energy
/// of a valid mesh is a valid mesh.
///
/// Accuracy: Gauss–Lobatto quadrature with two points per direction more than the degree, ends included; det F > 0 is
/// asked for at these points. The gradient is that of the sum (tests/meshes/relaxation_test.cpp)
///
/// Source: Garanzha et al. 2021
class Distortion {
 public:
  /// @param undistorted  X at the nodes, [3 x n_nodes]
  Distortion(const Lattice& lattice, const Eigen::Matrix3Xd& undistorted);

  /// E, infinite for cells that are inverted somewhere.
  [[nodiscard]] double energy(const Eigen::Matrix3Xd& x) const;
  /// ∂E/∂x, [3 x n_nodes].
  [[nodiscard]] Eigen::Matrix3Xd gradient(const Eigen::Matrix3Xd& x) const;
  /// Least det F.
  [[nodiscard]] double smallest_determinant(const Eigen::Matrix3Xd& x) const;
  /// Positive definite matrices close to the second derivatives of E by one component of x alone, one for each
  /// component: the part of the second derivative that is a square.
  [[nodiscard]] std::array<Eigen::SparseMatrix<double>, 3> stiffness(const Eigen::Matrix3Xd& x) const;

 private:
  using Matrices = std::vector<Matrix3>;

  /// Derivatives by the unit coordinates at the Gauss points of a cell.
  [[nodiscard]] Matrices unit_derivatives(const Lattice::Cell& cell, const Eigen::Matrix3Xd& x) const;
  /// F at the Gauss points of a cell.
  [[nodiscard]] Matrices deformation(std::size_t cell, const Eigen::Matrix3Xd& x) const;

  const Lattice& lattice_;
  NodalPolynomials line_;   ///< from nodes to Gauss points along an edge
  Eigen::MatrixXd slopes_;  ///< of all nodal functions by the unit coordinates, [3 n_points x nodes of a cell]
  std::vector<Matrices> to_undistorted_;     ///< ∂unit/∂X, for each cell
  std::vector<std::vector<double>> weight_;  ///< of the Gauss points in ∫ dX
};

}  // namespace vehd::meshes
