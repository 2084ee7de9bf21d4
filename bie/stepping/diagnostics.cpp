#include "bie/stepping/diagnostics.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/physics/bending.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Values at θ = 0 and θ = π.
Matrix pole_values(const Matrix& coefficients) {
  return evaluate_harmonics(coefficients, Vector{{0.0, std::numbers::pi}}, Vector::Zero(2));
}

/// Maximum of sign * column over the surface, poles included: the largest node, then the field itself where the
/// parabola through the node's derivatives has its top. Never above the true maximum; fourth order in the spacing.
double surface_maximum(const SphereGrid& grid, const SphereDerivatives& field, const Matrix& coefficients,
                       const Matrix& poles, Index column, double sign) {
  Index node = 0;
  const double value =
      std::max((sign * field.value.col(column)).maxCoeff(&node), (sign * poles.col(column)).maxCoeff());
  const Eigen::Vector2d gradient = sign * Eigen::Vector2d(field.d1(node, column), field.d2(node, column));
  Eigen::Matrix2d hessian;
  hessian << field.d11(node, column), field.d12(node, column), field.d12(node, column), field.d22(node, column);
  hessian *= -sign;
  // Away from a proper maximum (a flat field) the node itself is the answer.
  if (hessian(0, 0) <= 0.0 || hessian.determinant() <= 0.0) return value;
  const Eigen::Vector2d top = hessian.inverse() * gradient;
  const double theta = grid.theta[node / grid.n_phi];
  const double phi = grid.phi[node % grid.n_phi];
  const Matrix at_top =
      evaluate_harmonics(coefficients.col(column), Vector{{theta + top[0]}}, Vector{{phi + top[1] / std::sin(theta)}});
  return std::max(value, sign * at_top(0, 0));
}

/// Angle of the long axis of the gyration tensor against +x in the x-z plane of the laboratory, in (−90, 90] degrees.
double inclination(const Surface& s, const Frame& frame) {
  const Vector3 centre = s.position.transpose() * s.quadrature / s.quadrature.sum();
  const Matrix centred = s.position.rowwise() - centre.transpose();
  const Matrix3 gyration = centred.transpose() * s.quadrature.asDiagonal() * centred;
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(gyration);
  const Vector3 axis = frame.axes * solver.eigenvectors().col(2);
  const double degrees = std::atan2(axis.z(), axis.x()) * 180.0 / std::numbers::pi;
  // A vertical axis is +90 on either side of rounding.
  constexpr double kRounding = 1e-9;
  return degrees > 90.0 + kRounding ? degrees - 180.0 : degrees <= -90.0 + kRounding ? degrees + 180.0 : degrees;
}

/// √(energy of x in degrees above 2p/3 over energy in degrees from 1 up).
double spectrum_tail(const Matrix& position) {
  const int order = order_of(position.rows());
  const Index from = n_coefficients(2 * order / 3);
  return position.bottomRows(position.rows() - from).norm() / position.bottomRows(position.rows() - 1).norm();
}

/// Value where the parameter sphere has its north pole in the laboratory.
double north_value(const Frame& frame, const Vector& coefficients) {
  const Vector3 north = frame.axes.row(2);
  const double theta = std::atan2(std::hypot(north.x(), north.y()), north.z());
  const double phi = std::atan2(north.y(), north.x());
  return evaluate_harmonics(coefficients, Vector{{theta}}, Vector{{phi}})(0, 0);
}

}  // namespace

Diagnostics along_laboratory_axes(Diagnostics d, const Frame& frame, const SphereTransform& fine, const Surface& s,
                                  const State& state, const Fields& fields) {
  if (state.transmembrane_potential.size() > 0) {
    d.Vm_north = north_value(frame, state.transmembrane_potential);
    d.q_north = north_value(frame, fields.charge);
  }
  const Matrix position = state.position * frame.axes.transpose();
  const SphereDerivatives x = fine.synthesize_hessian(position);
  const Matrix poles = pole_values(position);
  const auto extent = [&](Index axis) {
    return surface_maximum(fine.grid(), x, position, poles, axis, 1.0) +
           surface_maximum(fine.grid(), x, position, poles, axis, -1.0);
  };
  d.extent_x = extent(0);
  d.extent_y = extent(1);
  d.extent_z = extent(2);
  d.inclination_deg = inclination(s, frame);
  return d;
}

Diagnostics diagnose(const State& state, const Membrane& membrane, const Fields& fields) {
  const Surface& s = membrane.surface;
  const SphereTransform& fine = membrane.fine;
  Diagnostics d;
  d.area = surface_area(s);
  d.volume = enclosed_volume(s);
  d.reduced_volume = 6.0 * std::sqrt(std::numbers::pi) * d.volume / std::pow(d.area, 1.5);
  d.bending_energy_scaled = bending_energy_scaled(s);
  d.area_drift = d.area / state.reference_area - 1.0;
  d.volume_drift = d.volume / state.reference_volume - 1.0;
  d.strain_max = fine.synthesize(state.area_strain).cwiseAbs().maxCoeff();
  d.spectrum_tail = spectrum_tail(state.position);
  if (fields.tension.size() > 0) d.tension_integral = fine.synthesize(fields.tension).col(0).dot(s.quadrature);
  if (state.transmembrane_potential.size() > 0) {
    const Matrix poles = pole_values(state.transmembrane_potential);
    const SphereDerivatives v = fine.synthesize_hessian(state.transmembrane_potential);
    d.Vm_max = std::max(surface_maximum(fine.grid(), v, state.transmembrane_potential, poles, 0, 1.0),
                        surface_maximum(fine.grid(), v, state.transmembrane_potential, poles, 0, -1.0));
  }
  return along_laboratory_axes(d, Frame{}, fine, s, state, fields);
}

}  // namespace vehd
