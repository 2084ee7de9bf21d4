#include "bie/stepping/solve/flow_system.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "bie/geometry/roundness.hpp"
#include "bie/physics/effects/bending.hpp"
#include "bie/physics/effects/tension.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/solve/sphere_spectrum.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {

VelocityField velocity_field(const Membrane& membrane, const Matrix& coefficients, bool hessian) {
  const SphereTransform& fine = membrane.fine;
  return {coefficients,
          hessian ? fine.synthesize_derivatives(coefficients) : fine.synthesize_first_derivatives(coefficients)};
}

Matrix membrane_velocity(const FlowParameters& parameters, const Membrane& membrane, const MembraneUnknowns& unknowns,
                         const CurvatureOptions& curvature) {
  if (unknowns.curvature.size() == 0 && unknowns.tension.size() == 0) {
    return Matrix::Zero(n_coefficients(membrane.fine.order()), 3);
  }
  Matrix force = Matrix::Zero(membrane.surface.n_points(), 3);
  if (unknowns.curvature.size() > 0) {
    const Index n_resolved = n_coefficients(membrane.fine.order());
    force += linearised_bending_force(*parameters.bending, membrane, unknowns.curvature.head(n_resolved));
    if (curvature.held_tension.size() > 0) {
      const Vector increment = curvature.of(membrane).synthesize(unknowns.curvature).col(0);
      force += 2.0 * curvature.held_tension.cwiseProduct(increment).asDiagonal() * membrane.surface.normal;
    }
  }
  if (unknowns.tension.size() > 0) force += tension_force(membrane, unknowns.tension);
  return membrane.velocity(membrane.layers.stokes_single.apply(membrane.weighted(force)) / parameters.viscosity);
}

bool uniform_tension_is_free(const FlowParameters& parameters, const Membrane& membrane) {
  return parameters.inextensible && !parameters.undulations &&
         distance_variation(membrane.surface) < thresholds::sphere_variation * membrane.radius;
}

namespace {

FlowLayout layout_of(const FlowParameters& parameters, const Membrane& membrane, double dt,
                     const FlowOptions& options) {
  FlowLayout layout{n_coefficients(options.curvature.all(membrane).order()),
                    n_coefficients(options.curvature.of(membrane).order()),
                    n_coefficients(membrane.fine.order()),
                    options.entries,
                    parameters.bending.has_value(),
                    parameters.inextensible};
  if (layout.entries.empty()) {
    layout.entries.resize(static_cast<std::size_t>(layout.n_all));
    std::iota(layout.entries.begin(), layout.entries.end(), Index{0});
  }
  if (layout.bending) {
    layout.curvature_scale = 1.0 / membrane.radius;
    layout.tension_scale =
        thresholds::strain_share * (parameters.viscosity * membrane.radius / dt +
                                    parameters.bending->modulus / (membrane.radius * membrane.radius));
  }
  if (parameters.undulations) {
    const Vector area_element = membrane.weighted(Vector::Ones(membrane.surface.n_points()));
    layout.of_dilation = Vector::Zero(layout.n());
    for (Index i = 0; i < layout.n(); ++i) {
      if (layout.is_tension(i)) {
        layout.of_dilation[i] =
            -area_element[layout.entries[static_cast<std::size_t>(i)]] / (parameters.viscosity * membrane.radius);
      }
    }
  }
  return layout;
}

/// Columns (h, λ) over their scales.
Matrix over_scales(const FlowLayout& layout, Matrix unknowns) {
  unknowns.topRows(layout.n_curvature()) /= layout.curvature_scale;
  unknowns.bottomRows(layout.n_tension()) /= layout.tension_scale;
  return unknowns;
}

/// The other way.
Matrix times_scales(const FlowLayout& layout, Matrix unknowns) {
  unknowns.topRows(layout.n_curvature()) *= layout.curvature_scale;
  unknowns.bottomRows(layout.n_tension()) *= layout.tension_scale;
  return unknowns;
}

/// All coefficients of the scalars, of which v holds those that can differ from zero, over their scales.
MembraneUnknowns unknowns_of(const FlowLayout& layout, const Vector& v) {
  const auto all = [&](const auto& entries) {
    Vector scalar = Vector::Zero(layout.n_all);
    scalar(layout.entries) = entries;
    return scalar;
  };
  MembraneUnknowns unknowns;
  if (layout.bending) unknowns.curvature = all(layout.curvature_scale * v.head(layout.n())).head(layout.n_curved);
  if (layout.tension) unknowns.tension = all(layout.tension_scale * v.tail(layout.n())).head(layout.n_resolved);
  if (layout.of_dilation.size() > 0) unknowns.tension[0] = 0.0;
  return unknowns;
}

/// The coefficients that can differ from zero, one scalar behind the other; scalars that are empty count as zero.
Vector entries_of(const FlowLayout& layout, const Vector& curvature, const Vector& divergence_or_tension) {
  Vector v = Vector::Zero(layout.size());
  const bool has_curvature = layout.bending && curvature.size() > 0;
  const bool has_tension = layout.tension && divergence_or_tension.size() > 0;
  for (Index i = 0; i < layout.n(); ++i) {
    const Index entry = layout.entries[static_cast<std::size_t>(i)];
    if (has_curvature && layout.is_curvature(i)) v[i] = curvature[entry];
    if (has_tension && layout.is_tension(i)) v[layout.n_curvature() + i] = divergence_or_tension[entry];
  }
  return v;
}

/// (h, λ) ↦ (Hop(u), J ∇_γ·u) of RecycledSubspaces as (h, λ) over their scales ↦ (h − dt Hop(u), J ∇_γ·u).
RecycledSubspace in_system(const FlowLayout& layout, const RecycledSubspace& known, double dt) {
  if (known.count() == 0) return {};
  RecycledSubspace result{over_scales(layout, known.arguments), known.responses};
  if (!layout.bending) return result;
  auto curvature = result.responses.topRows(layout.n());
  curvature = known.arguments.topRows(layout.n()) - dt * curvature;
  return result;
}

/// The other way.
RecycledSubspace in_memory(const FlowLayout& layout, const RecycledSubspace& learned, double dt) {
  if (learned.count() == 0) return {};
  RecycledSubspace result{times_scales(layout, learned.arguments), learned.responses};
  if (!layout.bending) return result;
  auto curvature = result.responses.topRows(layout.n());
  curvature = (result.arguments.topRows(layout.n()) - curvature) / dt;
  return result;
}

double mean_response(const FlowParameters& parameters, const Membrane& membrane) {
  return uniform_tension_response(membrane.radius, parameters.viscosity, parameters.viscosity_ratio);
}

/// (h, λ) over their scales ↦ the left sides of FlowRightHandSide and, behind them, the velocity.
LinearMap flow_map(const FlowParameters& parameters, const Membrane& membrane, double dt, const FlowLayout& layout,
                   const FlowOptions& options) {
  return [=, &membrane](const Vector& v) {
    const MembraneUnknowns unknowns = unknowns_of(layout, v);
    const VelocityField u =
        velocity_field(membrane, membrane_velocity(parameters, membrane, unknowns, options.curvature), layout.bending);
    Vector curvature;
    Vector divergence;
    if (layout.bending) {
      curvature =
          unknowns.curvature - dt * curvature_increment(membrane, options.curvature.of(membrane), u.derivatives);
    }
    if (layout.tension) {
      divergence = weighted_divergence(membrane, u.derivatives);
    }
    Vector result(layout.size() + u.coefficients.size());
    result.head(layout.size()) = entries_of(layout, curvature, divergence);
    if (layout.of_dilation.size() > 0) {
      result.segment(layout.n_curvature(), layout.n()) +=
          layout.tension_scale * v[layout.n_curvature()] * layout.of_dilation;
    }
    // What is not there is not asked for either.
    for (Index i = 0; i < layout.n_curvature(); ++i) {
      if (!layout.is_curvature(i)) result[i] = layout.curvature_scale * v[i];
    }
    for (Index i = 0; i < layout.n_tension(); ++i) {
      if (!layout.is_tension(i)) result[layout.n_curvature() + i] = v[layout.n_curvature() + i];
    }
    result.tail(u.coefficients.size()) = u.coefficients.reshaped();
    return result;
  };
}

LinearMap sphere_inverse(const FlowParameters& parameters, const Membrane& membrane, double dt,
                         const FlowLayout& layout, const FlowOptions& options) {
  const Vector& area = membrane.surface.quadrature;
  const Vector& held = options.curvature.held_tension;
  const double mean_tension = held.size() > 0 ? held.dot(area) / area.sum() : 0.0;
  const SphereFlow sphere{membrane.radius,
                          parameters.viscosity,
                          layout.bending ? parameters.bending->modulus : 0.0,
                          dt,
                          parameters.viscosity_ratio,
                          mean_tension};
  std::vector<Eigen::Matrix2d> inverse;
  for (int degree = 0; degree <= options.curvature.all(membrane).order(); ++degree) {
    if (degree > membrane.fine.order()) {
      inverse.push_back(
          Eigen::DiagonalMatrix<double, 2>(1.0 / unresolved_curvature(sphere, degree), layout.tension_scale));
      continue;
    }
    Eigen::Matrix2d block = sphere_flow_block(sphere, degree);
    // A uniform tension exerts no force on a sphere; away from it the response is weak but not zero.
    if (degree == 0) block(1, 1) = mean_response(parameters, membrane);
    if (degree == 0 && layout.of_dilation.size() > 0) block(1, 1) = layout.of_dilation[0];
    if (!layout.tension) block(1, 1) = 1.0;
    inverse.push_back(block.inverse());
  }
  // Per entry what it makes of both right-hand sides: of h first, then of λ, both over their scales.
  Matrix factors(layout.n(), 4);
  for (Index i = 0; i < layout.n(); ++i) {
    const Eigen::Matrix2d& m = inverse[static_cast<std::size_t>(degree_of(layout.entries[i]))];
    factors.row(i) << m.row(0) / layout.curvature_scale, m.row(1) / layout.tension_scale;
  }
  return [factors, bending = layout.bending, tension = layout.tension](const Vector& r) -> Vector {
    const Index n = factors.rows();
    if (!bending) return tension ? Vector(factors.col(3).cwiseProduct(r.head(n))) : Vector();
    if (!tension) return factors.col(0).cwiseProduct(r.head(n));
    Vector result(2 * n);
    result.head(n) = factors.col(0).cwiseProduct(r.head(n)) + factors.col(1).cwiseProduct(r.tail(n));
    result.tail(n) = factors.col(2).cwiseProduct(r.head(n)) + factors.col(3).cwiseProduct(r.tail(n));
    return result;
  };
}

}  // namespace

FlowSystem::FlowSystem(const FlowParameters& parameters, const Membrane& membrane, double dt,
                       const FlowOptions& options, RecycledSubspace known)
    : layout_(layout_of(parameters, membrane, dt, options)),
      curvature_(options.curvature.of(membrane)),
      dt_(dt),
      parameters_(parameters),
      membrane_(membrane),
      curvature_options_(options.curvature),
      // Cut to another degree responses are no longer those of their arguments.
      known_(known.arguments.rows() != layout_.size() ? RecycledSubspace{} : std::move(known)),
      solver_(flow_map(parameters, membrane, dt, layout_, options),
              sphere_inverse(parameters, membrane, dt, layout_, options), layout_.size(), 3 * layout_.n_resolved,
              in_system(layout_, known_, dt)) {}

FlowSystem::Solution FlowSystem::solve(const FlowRightHandSide& rhs, const MembraneUnknowns& start, double tolerance) {
  const Vector b = entries_of(layout_, rhs.curvature, rhs.divergence);
  const Vector x = over_scales(layout_, entries_of(layout_, start.curvature, start.tension));
  RecycledGcr::Solution solution = solver_.solve(b, x, {tolerance, thresholds::most_flow_iterations});
  return {solution.report, unknowns_of(layout_, solution.x), solution.further.reshaped(layout_.n_resolved, 3)};
}

const FlowSystem::Solution& FlowSystem::of_uniform_tension(double tolerance) {
  if (of_uniform_tension_) return *of_uniform_tension_;
  MembraneUnknowns uniform;
  uniform.tension = Vector::Zero(layout_.n_resolved);
  uniform.tension[0] = std::sqrt(4.0 * std::numbers::pi);
  const VelocityField u = velocity_field(
      membrane_, membrane_velocity(parameters_, membrane_, uniform, curvature_options_), layout_.bending);
  FlowRightHandSide rhs;
  if (layout_.bending) rhs.curvature = dt_ * curvature_increment(membrane_, curvature_, u.derivatives);
  rhs.divergence = -weighted_divergence(membrane_, u.derivatives);
  of_uniform_tension_ = solve(rhs, {}, tolerance);
  of_uniform_tension_->velocity += u.coefficients;
  of_uniform_tension_->unknowns.tension += uniform.tension;
  return *of_uniform_tension_;
}

RecycledSubspace FlowSystem::learned() const { return in_memory(layout_, solver_.learned(), dt_); }

RecycledSubspace FlowSystem::kept() const { return selected(known_, solver_.kept()); }

}  // namespace vehd
