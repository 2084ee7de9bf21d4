#include "bie/stepping/evaluation/growth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {

namespace {

/// Largest velocity along the normal but for that of degree 0, which changes nothing of a membrane.
double normal_speed(const SphereTransform& fine, const Matrix& position, const Matrix& velocity) {
  Matrix moving = velocity;
  moving.row(0).setZero();
  const SphereDerivatives there = fine.synthesize_gradient(position);
  const Matrix moved = fine.synthesize(moving);
  double largest = 0.0;
  for (Index i = 0; i < moved.rows(); ++i) {
    const Vector3 across = Vector3(there.d1.row(i)).cross(Vector3(there.d2.row(i)));
    largest = std::max(largest, std::abs(across.dot(Vector3(moved.row(i)))) / across.norm());
  }
  return largest;
}

/// σ T of one vesicle.
double exponent_of(const MembraneSpace& space, const VesicleState& vesicle, const VesicleFields& fields,
                   const VesicleDiagnostics& diagnostics, double time_left) {
  const double radius = std::sqrt(vesicle.reference_area / (4.0 * std::numbers::pi));
  const double rate = diagnostics.wrinkling_rate;
  if (rate <= 0.0) return 0.0;
  const double speed = normal_speed(space.fine_transform(), vesicle.position, fields.velocity);
  return rate * (speed * time_left > radius ? radius / speed : time_left);
}

}  // namespace

double expected_growth(const Model& model, const Discretisation& discretisation, const State& state,
                       const Evaluation& evaluation, double until, int highest_degree) {
  const double time_left = until - state.time;
  if (!model.mobile || time_left <= 0.0) return 1.0;
  double exponent = 0.0;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const VesicleDiagnostics& diagnostics = evaluation.diagnostics.vesicles[a];
    if (diagnostics.wrinkle_degree > highest_degree) continue;
    exponent = std::max(exponent, exponent_of(discretisation.vesicle(a), state.vesicles[a],
                                              evaluation.fields.vesicles[a], diagnostics, time_left));
  }
  return std::exp(std::min(exponent, std::log(thresholds::most_growth)));
}

}  // namespace vehd
