#include "bie/stepping/evaluation/growth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/wrinkling.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {

namespace {

/// Largest velocity along the normal but for that of degree 0, which changes nothing of a membrane.
double normal_speed(const SphereTransform& fine, const Matrix& position, Matrix velocity) {
  velocity.row(0).setZero();
  const SphereDerivatives there = fine.synthesize_gradient(position);
  const Matrix moved = fine.synthesize(velocity);
  double largest = 0.0;
  for (Index i = 0; i < moved.rows(); ++i) {
    const Vector3 across = Vector3(there.d1.row(i)).cross(Vector3(there.d2.row(i)));
    largest = std::max(largest, std::abs(across.dot(Vector3(moved.row(i)))) / across.norm());
  }
  return largest;
}

}  // namespace

double growth_of_wrinkles(const Model& model, const Discretisation& discretisation, const State& state,
                          const SolvedFields& solved) {
  double largest = 1.0;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const VesicleSolution& solution = solved.vesicles[a];
    const VesicleFields& fields = solved.fields.vesicles[a];
    // A sphere leaves its tension open.
    if (!model.mobile || fields.tension.size() == 0 || solution.is_sphere) continue;
    const Vector& weights = solution.membrane->surface.quadrature;
    const double tension = weights.dot(Vector(solution.membrane->fine.synthesize(fields.tension))) / weights.sum();
    const double radius = std::sqrt(state.vesicles[a].reference_area / (4.0 * std::numbers::pi));
    const MembraneSpace& space = discretisation.vesicle(a);
    const double rate = wrinkling_rate(flow_parameters(model, model.vesicles[a]), tension, radius, space.order());
    const double speed = normal_speed(space.fine_transform(), state.vesicles[a].position, fields.velocity);
    if (rate > 0.0) largest = std::max(largest, std::exp(rate * radius / speed));
  }
  return std::min(largest, thresholds::most_growth);
}

}  // namespace vehd
