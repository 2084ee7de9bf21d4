#include "bie/stepping/evaluation/growth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/wrinkling.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {

double growth_of_wrinkles(const Model& model, const State& state, const SolvedFields& solved) {
  double largest = 1.0;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const VesicleState& vesicle = state.vesicles[a];
    const VesicleFields& fields = solved.fields.vesicles[a];
    // A sphere leaves its tension open.
    if (!model.mobile || fields.tension.size() == 0 || solved.vesicles[a].is_sphere) continue;
    const Membrane& membrane = *solved.vesicles[a].membrane;
    const Vector& weights = membrane.surface.quadrature;
    const double tension = weights.dot(Vector(membrane.fine.synthesize(fields.tension))) / weights.sum();
    const double radius = std::sqrt(vesicle.reference_area / (4.0 * std::numbers::pi));
    const double rate =
        wrinkling_rate(flow_parameters(model, model.vesicles[a]), tension, radius, order_of(vesicle.position.rows()));
    // Degree 0 of the velocity changes nothing of a membrane.
    Matrix moving = fields.velocity;
    moving.row(0).setZero();
    const double speed =
        membrane.fine.synthesize(moving).cwiseProduct(membrane.surface.normal).rowwise().sum().cwiseAbs().maxCoeff();
    if (rate > 0.0) largest = std::max(largest, std::exp(rate * radius / speed));
  }
  return std::min(largest, thresholds::most_growth);
}

}  // namespace vehd
