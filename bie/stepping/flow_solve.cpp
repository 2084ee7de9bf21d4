#include "bie/stepping/flow_solve.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bie/physics/bending.hpp"
#include "bie/physics/tension.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/sphere_spectrum.hpp"

namespace vehd {

VelocityField velocity_field(const Membrane& membrane, const Matrix& coefficients, bool hessian) {
  return {coefficients,
          hessian ? membrane.fine.synthesize_hessian(coefficients) : membrane.fine.synthesize_gradient(coefficients)};
}

Matrix membrane_velocity(const Model& model, const Membrane& membrane, const MembraneUnknowns& unknowns,
                         const Vector& held_tension) {
  if (unknowns.curvature.size() == 0 && unknowns.tension.size() == 0) {
    return Matrix::Zero(n_coefficients(membrane.fine.order()), 3);
  }
  Matrix force = Matrix::Zero(membrane.surface.n_points(), 3);
  if (unknowns.curvature.size() > 0) {
    force += linearised_bending_force(*model.bending, membrane, unknowns.curvature);
    if (held_tension.size() > 0) {
      const Vector increment = membrane.fine.synthesize(unknowns.curvature).col(0);
      force += 2.0 * held_tension.cwiseProduct(increment).asDiagonal() * membrane.surface.normal;
    }
  }
  if (unknowns.tension.size() > 0) force += tension_force(membrane, unknowns.tension);
  return membrane.velocity(membrane.layers.stokes_single.apply(membrane.weighted(force)) / model.viscosity);
}

bool uniform_tension_is_free(const Model& model, const Membrane& membrane) {
  if (!model.inextensible) return false;
  MembraneUnknowns uniform;
  uniform.tension = Vector::Unit(n_coefficients(membrane.fine.order()), 0);
  const VelocityField u = velocity_field(membrane, membrane_velocity(model, membrane, uniform), false);
  const double response = weighted_divergence(membrane, u.derivatives)[0];
  const double typical =
      sphere_flow_block({membrane.radius, model.viscosity, 0.0, 0.0, model.viscosity_ratio}, 2)(1, 1);
  // The response grows with the square of the distance from a sphere: this is a distance of 1e-5 radii.
  constexpr double kNoResponse = 1e-10;
  return std::abs(response) < kNoResponse * std::abs(typical);
}

SolveReport solve_flow(const Model& model, const Membrane& membrane, double dt, const FlowRightHandSide& rhs,
                       const FlowOptions& options, MembraneUnknowns& unknowns) {
  const Index n = n_coefficients(membrane.fine.order());
  const bool bending = dt > 0.0 && model.bending.has_value();
  const Index n_curvature = bending ? n : 0;
  const Index n_tension = model.inextensible ? n : 0;
  const Index size = n_curvature + n_tension;
  if (size == 0) return {true, 0, 0.0};

  const auto unpack = [&](const Vector& v) { return MembraneUnknowns{v.head(n_curvature), v.tail(n_tension)}; };
  // Stand-in for the response of the area to a uniform tension, which vanishes on a sphere.
  const double mean_response =
      0.1 * sphere_flow_block({membrane.radius, model.viscosity, 0.0, 0.0, model.viscosity_ratio}, 2)(1, 1);
  const bool pinned = n_tension > 0 && options.pin_uniform_tension;
  const LinearMap map = [&](const Vector& v) {
    const VelocityField u =
        velocity_field(membrane, membrane_velocity(model, membrane, unpack(v), options.held_tension), bending);
    Vector result(size);
    if (bending) result.head(n) = v.head(n) - dt * curvature_increment(membrane, u.derivatives);
    if (n_tension > 0) result.tail(n) = weighted_divergence(membrane, u.derivatives);
    if (pinned) result[n_curvature] = mean_response * v[n_curvature];
    return result;
  };

  const Vector& area = membrane.surface.quadrature;
  const double mean_tension = options.held_tension.size() > 0 ? options.held_tension.dot(area) / area.sum() : 0.0;
  const SphereFlow sphere{membrane.radius,       model.viscosity, bending ? model.bending->modulus : 0.0, dt,
                          model.viscosity_ratio, mean_tension};
  std::vector<Eigen::Matrix2d> inverse;
  for (int degree = 0; degree <= membrane.fine.order(); ++degree) {
    Eigen::Matrix2d block = sphere_flow_block(sphere, degree);
    // A uniform tension exerts no force on a sphere; away from it the response is weak but not zero.
    if (degree == 0) block(1, 1) = mean_response;
    if (n_tension == 0) block(1, 1) = 1.0;
    inverse.push_back(block.inverse());
  }
  const LinearMap preconditioner = [&](const Vector& r) {
    Vector result(size);
    for (int degree = 0; degree <= membrane.fine.order(); ++degree) {
      const Eigen::Matrix2d& m = inverse[degree];
      for (Index i = coefficient_index(degree, -degree); i <= coefficient_index(degree, degree); ++i) {
        const double curvature = bending ? r[i] : 0.0;
        const double divergence = n_tension > 0 ? r[n_curvature + i] : 0.0;
        if (bending) result[i] = m(0, 0) * curvature + m(0, 1) * divergence;
        if (n_tension > 0) result[n_curvature + i] = m(1, 0) * curvature + m(1, 1) * divergence;
      }
    }
    return result;
  };

  Vector b(size);
  Vector x = Vector::Zero(size);
  if (bending) b.head(n) = rhs.curvature;
  if (n_tension > 0) b.tail(n) = rhs.divergence;
  if (pinned) b[n_curvature] = 0.0;
  if (bending && unknowns.curvature.size() == n) x.head(n) = unknowns.curvature;
  if (n_tension > 0 && unknowns.tension.size() == n) x.tail(n) = unknowns.tension;
  const SolveReport report = gmres(map, preconditioner, b, x, {options.tolerance, 120});
  unknowns = unpack(x);
  return report;
}

}  // namespace vehd
