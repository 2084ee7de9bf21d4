#include "bie/stepping/rigid_sphere.hpp"

#include <Eigen/Geometry>

#include "bie/stepping/reparametrisation.hpp"

namespace vehd {

namespace {

Vector3 surface_mean(const Surface& s, const Matrix& values) {
  return values.transpose() * s.quadrature / s.quadrature.sum();
}

/// Ω × r in every row.
Matrix rotating(const Vector3& rate, const Matrix& from_centre) {
  Matrix result(from_centre.rows(), 3);
  for (Index i = 0; i < result.rows(); ++i) result.row(i) = rate.cross(Vector3(from_centre.row(i)));
  return result;
}

/// Ω of the part Ω × r of a tangential flow: ∫ r × v dA = (2/3) A R² Ω, and all other parts contribute nothing.
Vector3 rotation_of(const Surface& s, const Matrix& from_centre, const Matrix& velocity, double radius) {
  Vector3 moment = Vector3::Zero();
  for (Index i = 0; i < velocity.rows(); ++i) {
    moment += s.quadrature[i] * Vector3(from_centre.row(i)).cross(Vector3(velocity.row(i)));
  }
  return 1.5 / (s.quadrature.sum() * radius * radius) * moment;
}

}  // namespace

ConstrainedMove rigid_sphere_move(const State& state, const Evaluation::Parts& parts, const Vector& tension, double dt,
                                  const Landing& landing) {
  const Membrane& membrane = parts.membrane;
  const Surface& s = membrane.surface;
  const Vector3 moved_centre =
      surface_mean(s, s.position) + dt * surface_mean(s, membrane.fine.synthesize(parts.velocity));
  const SphereVectors flow = sliding_part(membrane.fine, s, parts.velocity);
  const Matrix velocity = flow.d1.asDiagonal() * s.tangent_1 + flow.d2.asDiagonal() * s.tangent_2;
  const Matrix from_centre = s.position.rowwise() - surface_mean(s, s.position).transpose();
  const Vector3 rotation_rate = rotation_of(s, from_centre, velocity, membrane.radius);

  ConstrainedMove move;
  Matrix radial = from_centre + dt * (velocity - rotating(rotation_rate, from_centre));
  const Vector retraction = membrane.radius * radial.rowwise().norm().cwiseInverse();
  radial.array().colwise() *= retraction.array();
  const Eigen::AngleAxisd turn(rotation_rate.norm() * dt, rotation_rate.stableNormalized());
  radial *= turn.toRotationMatrix().transpose();
  move.position = membrane.fine.analyze(radial.rowwise() + moved_centre.transpose());
  move.tension = tension;
  const Vector stretch = make_surface(membrane.fine, move.position).area_element.cwiseQuotient(s.area_element);
  const Vector stretch_before = 1.0 + membrane.fine.synthesize(state.area_strain).col(0).array();
  move.area_strain = membrane.fine.analyze(stretch_before.cwiseProduct(stretch).array() - 1.0);
  move.landed = landing(move);
  move.accepted = true;
  return move;
}

}  // namespace vehd
