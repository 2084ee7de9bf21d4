#include "bie/stepping/rigid_sphere.hpp"

#include "bie/stepping/reparametrisation.hpp"

namespace vehd {

namespace {

Vector3 surface_mean(const Surface& s, const Matrix& values) {
  return values.transpose() * s.quadrature / s.quadrature.sum();
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

  ConstrainedMove move;
  Matrix radial = (s.position + dt * velocity).rowwise() - surface_mean(s, s.position).transpose();
  const Vector retraction = membrane.radius * radial.rowwise().norm().cwiseInverse();
  radial.array().colwise() *= retraction.array();
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
