#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "meshes/gauss_rule.hpp"
#include "meshes/lattice.hpp"

namespace vehd::meshes {

/// Distortion of the cells of a lattice, as an energy of its nodes x:
///
///   E(x) = ∫ [ (1 − w) (|F|²/3)^{3/2}/det F + w (det F + 1/det F)/2 ] dX,
///
/// with F the derivative of x with respect to the undistorted positions X. The first term is 1 for a similarity and
/// grows with every other change of shape; the second one penalises changes of volume; both are infinite if det F = 0.
/// A mesh whose energy is finite is therefore valid.
///
/// Accuracy: Gauss–Lobatto quadrature with degree + 3 points per direction, ends included; det F > 0 is required at
/// these points. The gradient is that of the sum (tests/meshes/relaxation_test.cpp)
///
/// Source: Garanzha et al. 2021
class Distortion {
 public:
  /// @param undistorted  X at the nodes, [3 x n_nodes]
  Distortion(const Lattice& lattice, const Eigen::Matrix3Xd& undistorted);

  /// E; infinite if a cell is inverted at a quadrature point.
  [[nodiscard]] double energy(const Eigen::Matrix3Xd& x) const;
  /// ∂E/∂x, [3 x n_nodes].
  [[nodiscard]] Eigen::Matrix3Xd gradient(const Eigen::Matrix3Xd& x) const;
  /// Smallest det F over the quadrature points.
  [[nodiscard]] double smallest_determinant(const Eigen::Matrix3Xd& x) const;
  /// Positive definite approximations of the second derivatives of E with respect to one component of x, one matrix for
  /// each component, from the terms that are squares.
  [[nodiscard]] std::array<Eigen::SparseMatrix<double>, 3> stiffness(const Eigen::Matrix3Xd& x) const;

 private:
  using Matrices = std::vector<Matrix3>;

  /// Derivatives with respect to the unit coordinates at the quadrature points of a cell.
  [[nodiscard]] Matrices unit_derivatives(const Lattice::Cell& cell, const Eigen::Matrix3Xd& x) const;
  /// F at the quadrature points of a cell.
  [[nodiscard]] Matrices deformation(std::size_t cell, const Eigen::Matrix3Xd& x) const;

  const Lattice& lattice_;
  NodalPolynomials line_;   ///< from nodes to quadrature points along an edge
  Eigen::MatrixXd slopes_;  ///< of nodal functions with respect to unit coordinates, [3 n_points x nodes of a cell]
  std::vector<Matrices> to_undistorted_;     ///< ∂unit/∂X, for each cell
  std::vector<std::vector<double>> weight_;  ///< of the quadrature points in ∫ dX
};

}  // namespace vehd::meshes
