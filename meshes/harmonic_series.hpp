#pragma once

#include <Eigen/Core>
#include <vector>

#include "meshes/types.hpp"

namespace vehd::meshes {

/// Functions on the unit sphere given by real orthonormal spherical harmonics (docs/conventions.md): one column per
/// function, coefficient (n, m) in row n² + n + m.
///
/// Evaluated as polynomials in the direction, Y_{n,m} = Q_n^m(z) Re (x + iy)^m (Im for m < 0), with Q_n^m the
/// normalised Legendre function without its factor sin^m θ. Nothing is singular at the poles; stable up to degree 64
/// and beyond. Immutable, so that threads may share it.
/// Accuracy: low degrees agree with the closed formulas to 1e-14, the sum of squares within a degree is constant to
/// 1e-12 up to degree 64 (tests/meshes/harmonic_series_test.cpp)
class HarmonicSeries {
 public:
  /// @param coefficients  [n_coefficients x n_columns]
  /// @throws std::invalid_argument if the number of rows is not the square of a positive integer
  explicit HarmonicSeries(const Eigen::MatrixXd& coefficients);

  /// Largest degree n.
  [[nodiscard]] int degree() const { return degree_; }
  /// Number of functions.
  [[nodiscard]] Eigen::Index n_columns() const { return coefficients_.rows(); }

  /// All columns at one unit vector, [n_columns].
  [[nodiscard]] Eigen::VectorXd value(const Point& direction) const;
  /// All columns at many unit vectors, [n_columns x n_points] from [3 x n_points]; several times faster per point.
  [[nodiscard]] Eigen::MatrixXd values(const Eigen::Matrix3Xd& directions) const;
  /// Gradient on the unit sphere, [n_columns x 3]: row c is the tangential vector ∇f_c in Cartesian components.
  [[nodiscard]] Eigen::MatrixXd gradient(const Point& direction) const;
  /// value() and gradient() in one pass over the harmonics, with the same shapes.
  void value_and_gradient(const Point& direction, Eigen::VectorXd& value, Eigen::MatrixXd& gradient) const;

 private:
  int degree_;
  Eigen::MatrixXd coefficients_;           // [n_columns x n_coefficients]: contiguous for each harmonic
  std::vector<double> sectoral_;           // Q_m^m
  std::vector<double> up_, down_, slope_;  // Q_n = up z Q_{n-1} − down Q_{n-2}; dQ_n^m/dz = slope Q_n^{m+1}
};

/// Unit vector r̂(θ, φ), θ from the +z axis, φ from +x.
Point direction_of(double theta, double phi);

}  // namespace vehd::meshes
