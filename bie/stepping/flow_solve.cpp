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

namespace {

/// Which unknowns there are.
struct Layout {
  Index n = 0;  ///< coefficients of a scalar
  bool bending = false;
  bool tension = false;
  [[nodiscard]] Index n_curvature() const { return bending ? n : 0; }
  [[nodiscard]] Index n_tension() const { return tension ? n : 0; }
  [[nodiscard]] Index size() const { return n_curvature() + n_tension(); }
};

Layout layout_of(const Model& model, const Membrane& membrane, double dt) {
  return {n_coefficients(membrane.fine.order()), dt > 0.0 && model.bending.has_value(), model.inextensible};
}

/// Stand-in for the response of the area to a uniform tension, which vanishes on a sphere.
double mean_response(const Model& model, const Membrane& membrane) {
  return 0.1 * sphere_flow_block({membrane.radius, model.viscosity, 0.0, 0.0, model.viscosity_ratio}, 2)(1, 1);
}

/// (h, λ) ↦ the left sides of FlowRightHandSide and, behind them, the velocity.
LinearMap flow_map(const Model& model, const Membrane& membrane, double dt, const FlowOptions& options) {
  const Layout layout = layout_of(model, membrane, dt);
  return [=, &model, &membrane](const Vector& v) {
    const MembraneUnknowns unknowns{v.head(layout.n_curvature()), v.tail(layout.n_tension())};
    const VelocityField u =
        velocity_field(membrane, membrane_velocity(model, membrane, unknowns, options.held_tension), layout.bending);
    Vector result(layout.size() + u.coefficients.size());
    if (layout.bending) {
      result.head(layout.n) = unknowns.curvature - dt * curvature_increment(membrane, u.derivatives);
    }
    if (layout.tension) {
      result.segment(layout.n_curvature(), layout.n) = weighted_divergence(membrane, u.derivatives);
      if (options.pin_uniform_tension) {
        result[layout.n_curvature()] = mean_response(model, membrane) * unknowns.tension[0];
      }
    }
    result.tail(u.coefficients.size()) = u.coefficients.reshaped();
    return result;
  };
}

LinearMap sphere_inverse(const Model& model, const Membrane& membrane, double dt, const FlowOptions& options) {
  const Layout layout = layout_of(model, membrane, dt);
  const Vector& area = membrane.surface.quadrature;
  const double mean_tension = options.held_tension.size() > 0 ? options.held_tension.dot(area) / area.sum() : 0.0;
  const SphereFlow sphere{membrane.radius,       model.viscosity, layout.bending ? model.bending->modulus : 0.0, dt,
                          model.viscosity_ratio, mean_tension};
  std::vector<Eigen::Matrix2d> inverse;
  for (int degree = 0; degree <= membrane.fine.order(); ++degree) {
    Eigen::Matrix2d block = sphere_flow_block(sphere, degree);
    // A uniform tension exerts no force on a sphere; away from it the response is weak but not zero.
    if (degree == 0) block(1, 1) = mean_response(model, membrane);
    if (!layout.tension) block(1, 1) = 1.0;
    inverse.push_back(block.inverse());
  }
  return [=](const Vector& r) {
    Vector result(layout.size());
    for (int degree = 0; degree < static_cast<int>(inverse.size()); ++degree) {
      const Eigen::Matrix2d& m = inverse[degree];
      for (Index i = coefficient_index(degree, -degree); i <= coefficient_index(degree, degree); ++i) {
        const double curvature = layout.bending ? r[i] : 0.0;
        const double divergence = layout.tension ? r[layout.n_curvature() + i] : 0.0;
        if (layout.bending) result[i] = m(0, 0) * curvature + m(0, 1) * divergence;
        if (layout.tension) result[layout.n_curvature() + i] = m(1, 0) * curvature + m(1, 1) * divergence;
      }
    }
    return result;
  };
}

}  // namespace

FlowSystem::FlowSystem(const Model& model, const Membrane& membrane, double dt, FlowOptions options)
    : n_(layout_of(model, membrane, dt).n),
      n_curvature_(layout_of(model, membrane, dt).n_curvature()),
      n_tension_(layout_of(model, membrane, dt).n_tension()),
      pinned_(n_tension_ > 0 && options.pin_uniform_tension),
      solver_(flow_map(model, membrane, dt, options), sphere_inverse(model, membrane, dt, options),
              n_curvature_ + n_tension_, 3 * n_) {}

FlowSystem::Solution FlowSystem::solve(const FlowRightHandSide& rhs, const MembraneUnknowns& start, double tolerance) {
  constexpr int kMaxIterations = 120;
  Vector b(n_curvature_ + n_tension_);
  Vector x = Vector::Zero(b.size());
  if (n_curvature_ > 0) b.head(n_) = rhs.curvature;
  if (n_tension_ > 0) b.tail(n_) = rhs.divergence;
  if (pinned_) b[n_curvature_] = 0.0;
  if (n_curvature_ > 0 && start.curvature.size() == n_) x.head(n_) = start.curvature;
  if (n_tension_ > 0 && start.tension.size() == n_) x.tail(n_) = start.tension;
  RecycledGcr::Solution solution = solver_.solve(b, x, {tolerance, kMaxIterations});
  return {
      solution.report, {solution.x.head(n_curvature_), solution.x.tail(n_tension_)}, solution.further.reshaped(n_, 3)};
}

}  // namespace vehd
