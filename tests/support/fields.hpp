#pragma once

#include <cmath>
#include <random>

#include "bie/sphere/grid.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/transform.hpp"

/// Harmonic fields for tests: reproducible random coefficients, points of a grid, fields with moved poles.
namespace vehd::testing {

/// Uniform in [-1, 1]; the same numbers for the same seed on every machine.
inline Matrix random_coefficients(int order, int n_fields, unsigned seed) {
  std::mt19937 engine(seed);
  Matrix c(n_coefficients(order), n_fields);
  for (Index i = 0; i < c.size(); ++i) c.data()[i] = 2.0 * (engine() / 4294967295.0) - 1.0;
  return c;
}

/// Random coefficients of degree ≤ band, zero above: a field that every order ≥ band holds exactly.
inline Matrix smooth_coefficients(int order, int band, int n_fields, unsigned seed) {
  return resize_order(random_coefficients(band, n_fields, seed), order);
}

/// A single harmonic.
inline Vector harmonic(int order, int n, int m) { return Vector::Unit(n_coefficients(order), coefficient_index(n, m)); }

inline double max_difference(const Matrix& a, const Matrix& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// Largest difference over the largest entry of the reference.
inline double relative_difference(const Matrix& a, const Matrix& reference) {
  return max_difference(a, reference) / reference.cwiseAbs().maxCoeff();
}

inline Vector row_dot(const Matrix& a, const Matrix& b) { return a.cwiseProduct(b).rowwise().sum(); }

/// θ and φ of every grid point, theta-major.
struct GridAngles {
  Vector theta, phi;
};

inline GridAngles grid_angles(const SphereGrid& grid) {
  return {grid.theta.transpose().replicate(grid.n_phi, 1).reshaped(), grid.phi.replicate(grid.n_theta, 1)};
}

/// Unit vectors of every grid point, [n_points x 3].
inline Matrix grid_directions(const SphereGrid& grid) {
  const GridAngles angles = grid_angles(grid);
  const Eigen::ArrayXd sine = angles.theta.array().sin();
  Matrix directions(grid.n_points(), 3);
  directions << sine * angles.phi.array().cos(), sine * angles.phi.array().sin(), angles.theta.array().cos();
  return directions;
}

/// A rotation that moves the poles to general position.
inline Matrix3 general_rotation() {
  return (Eigen::AngleAxisd(0.7, Vector3::UnitZ()) * Eigen::AngleAxisd(1.1, Vector3::UnitY()) *
          Eigen::AngleAxisd(-0.4, Vector3::UnitZ()))
      .toRotationMatrix();
}

/// Coefficients of f(R s): the same field on the same surface, with the poles of the parametrisation elsewhere.
inline Matrix move_poles(const Matrix& coefficients, const Matrix3& rotation) {
  const int order = order_of(coefficients.rows());
  const SphereTransform transform(order, make_grid(order));
  const Matrix s = grid_directions(transform.grid()) * rotation.transpose();
  Vector theta(s.rows());
  Vector phi(s.rows());
  for (Index i = 0; i < s.rows(); ++i) {
    theta[i] = std::atan2(std::hypot(s(i, 0), s(i, 1)), s(i, 2));
    phi[i] = std::atan2(s(i, 1), s(i, 0));
  }
  return transform.analyze(evaluate_harmonics(coefficients, theta, phi));
}

}  // namespace vehd::testing
