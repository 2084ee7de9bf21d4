#include "bie/stepping/evaluation/wrinkling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/physics/effects/tension.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {

double wrinkle_degree(const FlowParameters& parameters, double least_tension, double radius) {
  if (!(least_tension < 0.0)) return 0.0;
  if (!parameters.bending) return std::numeric_limits<double>::infinity();
  return radius * std::sqrt(-2.0 * least_tension / (3.0 * parameters.bending->modulus));
}

namespace {

double disturbance_rate(const FlowParameters& parameters, double tension, double radius, int degree) {
  const double rigidity = parameters.bending ? 0.5 * parameters.bending->modulus : 0.0;
  const double n = degree, product = n * (n + 1.0);
  const double driving = -rigidity * product / (radius * radius) - tension;
  const double cubic = (2.0 * n + 3.0) * n * n;
  const double friction = (cubic - 5.0) * parameters.viscosity_ratio + cubic + 4.0;
  return (n - 1.0) * product * (n + 2.0) * driving / (parameters.viscosity * radius * friction);
}

}  // namespace

double wrinkling_rate(const FlowParameters& parameters, double tension, double radius, int highest_degree) {
  double fastest = 0.0;
  for (int degree = 2; degree <= highest_degree; ++degree) {
    fastest = std::max(fastest, disturbance_rate(parameters, tension, radius, degree));
  }
  return fastest;
}

double growth_of_wrinkles(const Model& model, const State& state, const SolvedFields& solved) {
  double largest = 1.0;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const VesicleState& vesicle = state.vesicles[a];
    const VesicleFields& fields = solved.fields.vesicles[a];
    // The tension of a sphere is undetermined.
    if (!model.mobile || fields.tension.size() == 0 || solved.vesicles[a].is_sphere) continue;
    const Membrane& membrane = *solved.vesicles[a].membrane;
    const double tension = mean_tension(membrane.fine, membrane.surface, fields.tension);
    const double radius = vesicle.radius();
    const double rate =
        wrinkling_rate(flow_parameters(model, model.vesicles[a]), tension, radius, order_of(vesicle.position.rows()));
    // Degree 0 of the velocity only translates the membrane.
    Matrix moving = fields.velocity;
    moving.row(0).setZero();
    const double speed =
        membrane.fine.synthesize(moving).cwiseProduct(membrane.surface.normal).rowwise().sum().cwiseAbs().maxCoeff();
    if (rate > 0.0) largest = std::max(largest, std::exp(rate * radius / speed));
  }
  return std::min(largest, thresholds::most_growth);
}

}  // namespace vehd
