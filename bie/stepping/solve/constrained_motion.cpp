#include "bie/stepping/solve/constrained_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "bie/physics/effects/bending.hpp"
#include "bie/physics/effects/tension.hpp"
#include "bie/physics/effects/undulations.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Largest number of passes. A pass that converges squares its residual or reduces it to its own tolerance.
constexpr int most_passes = 24;
/// Bounds of the relative tolerance of a pass. Every pass starts from the full residual, so it needs no more digits
/// than its linearisation has (a step changes the shape by about a hundredth), nor more than are missing. Measured.
constexpr double finest_pass = 1e-2;
constexpr double loosest_pass = 0.3;
/// A pass that leaves more than this of its residual stagnates.
constexpr double stagnation_ratio = 0.9;
/// Stagnating passes that a step can have and still converge. Each further one multiplies the tolerance of passes by
/// this factor, down to the tightest: the norm of the solve weighs Eq. (28) at degree 64 a few thousandths of what it
/// does at degree 1.
constexpr int stagnating_passes = 4;
constexpr double tighter_pass = 0.1;
constexpr double tightest_pass = 1e-5;
/// Changes of H smaller than this, relative to H, are those of a shape at rest: five digits of them in Eq. (28) are
/// below the tolerance of the constraint.
constexpr double curvature_floor = 1e-6;
/// Largest relative change of an area element by a motion before it is corrected: beyond a half the linearised
/// constraint can turn an element over.
constexpr double largest_stretch = 0.5;

double pass_tolerance(double largest_excess) {
  return std::clamp(loosest_pass / largest_excess, finest_pass, loosest_pass);
}

/// Share of the strain of former steps that this step takes back.
double share_taken_back(const Vector& strain) {
  const double largest = strain.cwiseAbs().maxCoeff();
  return std::clamp(2.0 - largest / thresholds::known_strain, 0.0, 1.0);
}

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

/// The area of a membrane with undulations, which follows from the change of the mean tension in a motion.
class FreeArea {
 public:
  /// @param area  at the beginning of the motion
  FreeArea(const Undulations& undulations, double area) : law_(undulations), tension_(law_.tension(area)) {}

  /// The area at the current mean tension.
  [[nodiscard]] double target() const { return law_.area(tension_); }

  /// Uniform tension to add so that area and mean tension satisfy the law.
  /// @param area      without it
  /// @param response  change of the area for a uniform tension of 1, negative
  double raise_tension(double area, double response) {
    double tension = tension_;
    // Newton's method for an increasing concave function: from below it rises to the root.
    constexpr int most_iterations = 100;
    for (int i = 0; i < most_iterations; ++i) {
      const double residual = law_.area(tension) - area - response * (tension - tension_);
      const double next = tension - residual / (law_.slope(tension) - response);
      const double allowed = std::max(next, 0.5 * (tension + law_.least_tension()));
      if (std::abs(allowed - tension) <= 1e-14 * std::abs(allowed)) break;
      tension = allowed;
    }
    return tension - std::exchange(tension_, tension);
  }

 private:
  AreaLaw law_;
  double tension_;
};

/// Remaining errors of a motion.
struct Errors {
  double area = 0.0, volume = 0.0;  ///< relative, signed
  double strain = 0.0;              ///< of the degrees that a tension can correct
  double curvature = 0.0;           ///< of Eq. (28), relative to the step's own change of H

  [[nodiscard]] double of_constraint() const { return std::max(std::abs(volume), std::abs(area)); }
};

/// The iteration: passes of `solve` until `errors` are small.
class Iteration {
 public:
  Iteration(const MotionContext& context, const MotionStart& start, double dt, const SphereTransform& curvature)
      : context_(context),
        start_(start),
        dt_(dt),
        curvature_transform_(curvature),
        area_(surface_area(context.membrane.surface)),
        stretch_before_(1.0 + fine().synthesize(context.state.area_strain).col(0).array()),
        to_take_back_(share_taken_back(stretch_before_.array() - 1.0) * (stretch_before_.array() - 1.0)),
        normal_(fine().analyze(context.membrane.surface.normal)),
        velocity_(start.velocity),
        curvature_(Vector::Zero(n_coefficients(curvature.order()))) {
    motion_.material = start.fields;
    if (context.parameters.undulations) {
      free_area_.emplace(*context.parameters.undulations, measure(fine(), start.fields.position).area);
    }
    if (inextensible()) {
      normal_divergence_ = weighted_divergence(context.membrane, fine().synthesize_first_derivatives(normal_));
    }
    if (bending()) mean_curvature_ = fine().analyze(context.membrane.surface.mean_curvature).norm();
  }

  /// Moves the material points by the velocity so far. @throws ConvergenceError if that tears the membrane
  void move() {
    const Membrane& membrane = context_.membrane;
    const SphereDerivatives u =
        bending() ? fine().synthesize_derivatives(velocity_) : fine().synthesize_first_derivatives(velocity_);
    if (bending()) {
      rhs_.shape = dt_ * curvature_increment(membrane, curvature_transform_, u) - curvature_;
      if (pass_ == 0) curvature_scale_ = std::max(rhs_.shape.norm(), curvature_floor * mean_curvature_);
      errors_.curvature = rhs_.shape.norm() / curvature_scale_;
    }
    motion_.material.position = start_.fields.position + dt_ * velocity_;
    after_ = measure(fine(), motion_.material.position);
    Eigen::ArrayXd stretch = after_.area_element.cwiseQuotient(membrane.surface.area_element);
    is_torn_ = !(stretch.minCoeff() > 1.0 - largest_stretch && stretch.maxCoeff() < 1.0 + largest_stretch);
    if (is_torn_) {
      if (!bending() || errors_.curvature <= context_.settings.curvature_tolerance) {
        throw ConvergenceError(fmt::format("area elements change by factors {:.2g} to {:.2g} in one step",
                                           stretch.minCoeff(), stretch.maxCoeff()));
      }
      // Bending has not responded to this velocity yet, and a stiff membrane undoes the stretch in the next pass: until
      // then the constraint is linearised about the start.
      const Vector growth = dt_ * surface_divergence(membrane.surface, u);
      stretch = 1.0 + growth.array();
      after_.area = area_ + membrane.surface.quadrature.dot(growth);
      after_.volume = enclosed_volume(membrane.surface) + dt_ * flux();
    }
    if (free_area_) stretch *= area_ / after_.area;
    strain_ = stretch_before_.array() * stretch - 1.0;
    weighted_strain_ = membrane.weighted(Vector((1.0 + to_take_back_.array()) * stretch - 1.0));
    errors_.volume = (after_.volume + arrival_volume_) / context_.state.reference_volume - 1.0;
    errors_.area = inextensible() ? (after_.area + arrival_area_) / target_area() - 1.0 : 0.0;
    if (pass_ == 0) motion_.raw_area = errors_.area;
    // A tension of degree p corrects only degrees up to p, and degree 0 is the error of the area.
    errors_.strain = inextensible() ? weighted_strain_.tail(weighted_strain_.size() - 1).norm() / area_ : 0.0;
  }

  /// Are the constraints met, also on arrival? At least one pass is made, however small its residual, because it is the
  /// step itself.
  bool arrives(const Arrival& arrival) {
    const NumericalSettings& settings = context_.settings;
    const bool is_there = pass_ > 0 && !is_torn_ && errors_.of_constraint() <= settings.constraint_tolerance &&
                          errors_.strain <= settings.strain_tolerance &&
                          errors_.curvature <= settings.curvature_tolerance;
    if (!is_there) return false;
    motion_.material.area_strain = fine().analyze(strain_);
    motion_.arrived = arrival(motion_.material);
    const Measure there = measure(fine(), motion_.arrived.position);
    arrival_area_ = there.area - after_.area;
    arrival_volume_ = there.volume - after_.volume;
    if (before_arrival_.size() == 0) before_arrival_ = motion_.material.position;
    motion_.arrival_shift =
        (motion_.material.position - before_arrival_).norm() / std::sqrt(context_.state.reference_area);
    errors_.volume = there.volume / context_.state.reference_volume - 1.0;
    errors_.area = inextensible() ? there.area / target_area() - 1.0 : 0.0;
    return errors_.of_constraint() <= settings.constraint_tolerance;
  }

  /// One pass: (h, λ) and a uniform normal velocity that correct the remaining errors. @throws ConvergenceError
  void solve(FlowSystem& flow, int& iterations) {
    const double push = -errors_.volume * context_.state.reference_volume / (area_ * dt_);
    if (inextensible()) {
      // Degree 0 is the error of the area itself, without the truncation of the strain field.
      weighted_strain_[0] = errors_.area * target_area() / coefficient_of_one;
      rhs_.tension = -weighted_strain_ / dt_ - push * normal_divergence_;
    }
    // The norm of the solve weighs curvature and strain together, high degrees least. With a loose tolerance the
    // residual of one can be hidden by rounding in the other, that of the area elements.
    if (excess() > stagnation_ratio * excess_before_) ++stagnating_;
    excess_before_ = excess();
    const double tightening = std::pow(tighter_pass, std::max(0, stagnating_ - stagnating_passes));
    const double tolerance = std::max(tightening * pass_tolerance(excess()), tightest_pass);
    const FlowSystem::Solution increment = flow.solve({flow.equations().front().rows(rhs_)}, tolerance);
    iterations += increment.report.iterations;
    // The next pass corrects what this one leaves, as long as the residual falls.
    if (!increment.report.converged() && !(increment.report.residual < stagnation_ratio)) {
      throw ConvergenceError(fmt::format("velocity solve, Eq. (27): residual {:.1e} after {} iterations",
                                         increment.report.residual, increment.report.iterations));
    }
    const Matrix velocity = push * normal_ + increment.velocities.front();
    add(1.0, velocity, increment.unknowns.front());
    if (free_area_) {
      const FlowSystem::Solution& uniform = flow.of_uniform_tension(tightest_pass);
      const Matrix& response = uniform.velocities.front();
      const double area = after_.area + arrival_area_ + dt_ * growth(velocity);
      add(free_area_->raise_tension(area, dt_ * growth(response)), response, uniform.unknowns.front());
    }
    ++pass_;
  }

  [[nodiscard]] int pass() const { return pass_; }
  [[nodiscard]] Motion take() { return std::move(motion_); }
  [[nodiscard]] std::string text() const {
    return fmt::format("area error {:.1e}, volume error {:.1e}, strain {:.1e}, curvature {:.1e} after {} passes",
                       errors_.area, errors_.volume, errors_.strain, errors_.curvature, pass_);
  }

 private:
  [[nodiscard]] const SphereTransform& fine() const { return context_.membrane.fine; }
  [[nodiscard]] double target_area() const { return free_area_ ? free_area_->target() : context_.state.reference_area; }
  /// Rate of change of the area under a velocity.
  [[nodiscard]] double growth(const Matrix& velocity) const { return area_ * dilation(context_.membrane, velocity); }
  void add(double factor, const Matrix& velocity, const FlowScalars& unknowns) {
    velocity_ += factor * velocity;
    if (bending()) curvature_ += factor * unknowns.shape;
    if (inextensible()) motion_.material.tension += factor * unknowns.tension;
  }
  /// ∫u·n dA of the velocity so far.
  [[nodiscard]] double flux() const {
    const Surface& s = context_.membrane.surface;
    return s.quadrature.dot(fine().synthesize(velocity_).cwiseProduct(s.normal).rowwise().sum());
  }
  [[nodiscard]] bool bending() const { return context_.parameters.bending.has_value(); }
  [[nodiscard]] bool inextensible() const { return context_.parameters.inextensible; }
  /// Largest error over its tolerance.
  [[nodiscard]] double excess() const {
    const NumericalSettings& settings = context_.settings;
    return std::max({std::abs(errors_.volume) / settings.constraint_tolerance,
                     std::abs(errors_.area) / settings.constraint_tolerance, errors_.strain / settings.strain_tolerance,
                     errors_.curvature / settings.curvature_tolerance});
  }

  const MotionContext& context_;
  const MotionStart& start_;
  double dt_;
  const SphereTransform& curvature_transform_;
  double area_;
  Vector stretch_before_;
  Vector to_take_back_;                // part of the former strain
  Matrix normal_;                      // velocity of the volume correction, for unit amplitude
  Vector normal_divergence_;           // weighted
  std::optional<FreeArea> free_area_;  // with undulations
  double mean_curvature_ = 0.0;
  double curvature_scale_ = 0.0;
  int pass_ = 0;
  bool is_torn_ = false;  // by the velocity so far, to which bending has not responded
  double excess_before_ = std::numeric_limits<double>::infinity();
  int stagnating_ = 0;
  Matrix velocity_;
  Vector curvature_;  // h of Eq. (28), accumulated
  Measure after_;
  Vector strain_;
  Vector weighted_strain_;  // of the strain that this step corrects
  FlowScalars rhs_;
  Errors errors_;
  // Change of area and volume by the last arrival.
  double arrival_area_ = 0.0;
  double arrival_volume_ = 0.0;
  Matrix before_arrival_;  // position of the material without that correction
  Motion motion_;
};

}  // namespace

Motion constrained_motion(const MotionContext& context, const MotionStart& start, double dt, FlowSystem& flow,
                          const Arrival& arrival, int& iterations) {
  Iteration iteration(context, start, dt, flow.equations().front().curvature_transform());
  for (;;) {
    iteration.move();
    if (iteration.arrives(arrival)) return iteration.take();
    const std::string left = iteration.text();
    iteration.solve(flow, iterations);
    if (iteration.pass() > most_passes) throw ConvergenceError(left);
  }
}

}  // namespace vehd
