#include "bie/stepping/constrained_move.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/physics/bending.hpp"
#include "bie/physics/tension.hpp"
#include "bie/stepping/discretisation_tables.hpp"

namespace vehd {

namespace {

constexpr int kMaxPasses = 24;
/// Every pass starts from the full residual, so it needs no more digits than its linearisation is worth, nor more than
/// are left to gain.
double pass_tolerance(double largest_excess) {
  constexpr double kLinearisation = 1e-2;
  constexpr double kRoughest = 0.3;
  return std::clamp(kRoughest / largest_excess, kLinearisation, kRoughest);
}

/// Smaller changes of H, relative to H, are those of a shape at rest.
constexpr double kCurvatureFloor = 1e-6;
/// Largest relative change of an area element that a step may make before corrections.
constexpr double kLargestStretch = 0.5;

/// Area element, area and volume of a shape whose curvature is not needed.
struct Measure {
  Vector area_element;
  double area;
  double volume;
};

Measure measure(const SphereTransform& fine, const Matrix& position) {
  const SphereDerivatives x = fine.synthesize_gradient(position);
  Measure result{Vector(x.value.rows()), 0.0, 0.0};
  const SphereGrid& grid = fine.grid();
  for (Index i = 0; i < x.value.rows(); ++i) {
    const Vector3 area_vector = Vector3(x.d1.row(i)).cross(Vector3(x.d2.row(i)));
    const double weight = grid.weight[i / grid.n_phi];
    result.area_element[i] = area_vector.norm();
    result.area += weight * result.area_element[i];
    result.volume += weight * area_vector.dot(Vector3(x.value.row(i))) / 3.0;
  }
  return result;
}

}  // namespace

ConstrainedMove constrained_move(const Model& model, const Discretisation& discretisation, const State& state,
                                 const Evaluation::Parts& parts, const MoveStart& start, double dt, FlowSystem& flow,
                                 const Landing& landing) {
  const Membrane& membrane = parts.membrane;
  const NumericalSettings& settings = discretisation.settings();
  const bool bending = model.bending.has_value();
  const Vector& area_element = membrane.surface.area_element;
  const double area = surface_area(membrane.surface);
  const Vector stretch_before = 1.0 + membrane.fine.synthesize(state.area_strain).col(0).array();
  // Velocity of the volume correction, for unit amplitude.
  const Matrix normal = membrane.fine.analyze(membrane.surface.normal);
  Vector normal_divergence;
  if (model.inextensible) {
    normal_divergence = weighted_divergence(membrane, membrane.fine.synthesize_gradient(normal));
  }

  ConstrainedMove move;
  Matrix velocity = start.velocity;
  move.tension = start.tension;
  Vector curvature = Vector::Zero(normal.rows());  // h of Eq. (28), accumulated
  const double mean_curvature = bending ? membrane.fine.analyze(membrane.surface.mean_curvature).norm() : 0.0;
  double curvature_scale = 0.0;
  // What landing adds to area and volume, known from the last landing.
  double landing_area = 0.0;
  double landing_volume = 0.0;
  for (int pass = 0; pass <= kMaxPasses; ++pass) {
    move.position = start.position + dt * velocity;
    const Measure after = measure(membrane.fine, move.position);
    const Eigen::ArrayXd stretch = after.area_element.cwiseQuotient(area_element);
    if (!(stretch.minCoeff() > 1.0 - kLargestStretch && stretch.maxCoeff() < 1.0 + kLargestStretch)) {
      move.reason = fmt::format("area elements change by factors {:.2g} to {:.2g} in one step", stretch.minCoeff(),
                                stretch.maxCoeff());
      return move;
    }
    const Vector strain = stretch_before.array() * stretch - 1.0;
    Vector weighted_strain = membrane.weighted(strain);
    double volume_error = (after.volume + landing_volume) / state.reference_volume - 1.0;
    double area_error = model.inextensible ? (after.area + landing_area) / state.reference_area - 1.0 : 0.0;
    if (pass == 0) move.raw_area = area_error;
    // Only degrees up to p can be answered by a tension of degree p, and degree 0 is the area's own.
    const double strain_error =
        model.inextensible ? weighted_strain.tail(weighted_strain.size() - 1).norm() / area : 0.0;
    FlowRightHandSide rhs;
    double curvature_error = 0.0;
    if (bending) {
      rhs.curvature = dt * curvature_increment(membrane, membrane.fine.synthesize_hessian(velocity)) - curvature;
      if (pass == 0) curvature_scale = std::max(rhs.curvature.norm(), kCurvatureFloor * mean_curvature);
      curvature_error = rhs.curvature.norm() / curvature_scale;
    }
    const double tolerance = settings.constraint_tolerance;
    const auto holds = [&] { return std::max(std::abs(volume_error), std::abs(area_error)) <= tolerance; };
    // The first pass is the step itself, however small its residual.
    if (pass > 0 && holds() && strain_error <= settings.strain_tolerance &&
        curvature_error <= settings.curvature_tolerance) {
      move.area_strain = membrane.fine.analyze(strain);
      move.landed = landing(move);
      const Measure landed = measure(membrane.fine, move.landed.leftCols(3));
      landing_area = landed.area - after.area;
      landing_volume = landed.volume - after.volume;
      volume_error = landed.volume / state.reference_volume - 1.0;
      area_error = model.inextensible ? landed.area / state.reference_area - 1.0 : 0.0;
      if (holds()) {
        move.accepted = true;
        return move;
      }
    }
    move.reason = fmt::format("area error {:.1e}, volume error {:.1e}, strain {:.1e}, curvature {:.1e} after {} passes",
                              area_error, volume_error, strain_error, curvature_error, pass);

    const double push = -volume_error * state.reference_volume / (area * dt);
    if (model.inextensible) {
      // The area as a whole answers for itself, free of what truncation does to the strain field.
      weighted_strain[0] = area_error * state.reference_area / std::sqrt(4.0 * std::numbers::pi);
      rhs.divergence = -weighted_strain / dt - push * normal_divergence;
    }
    const double excess =
        std::max({std::abs(volume_error) / tolerance, std::abs(area_error) / tolerance,
                  strain_error / settings.strain_tolerance, curvature_error / settings.curvature_tolerance});
    const FlowSystem::Solution increment = flow.solve(rhs, {}, pass_tolerance(excess));
    move.iterations += increment.report.iterations;
    // What a pass leaves the next one answers for, as long as it gains.
    constexpr double kGainless = 0.9;
    if (!increment.report.converged && !(increment.report.residual < kGainless)) {
      move.reason = fmt::format("velocity solve, Eq. (27): residual {:.1e} after {} iterations",
                                increment.report.residual, increment.report.iterations);
      return move;
    }
    velocity += push * normal + increment.velocity;
    if (bending) curvature += increment.unknowns.curvature;
    if (model.inextensible) move.tension += increment.unknowns.tension;
  }
  return move;
}

}  // namespace vehd
