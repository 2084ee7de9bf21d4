#include "bie/stepping/time/step_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bie/stepping/time/corrections.hpp"

namespace vehd {

namespace {

/// Weights at x of the values at the places: Lagrange's polynomials, times powers of x that are 1 at the place so that
/// they vanish at x = 0.
Vector weights_from_zero(const std::vector<double>& places, double x, StepPolynomial::Fit fit) {
  const std::size_t first = fit == StepPolynomial::Fit::later_nodes ? 1 : 0;
  const int power = fit == StepPolynomial::Fit::nodes_and_rate ? 2 : 1;
  Vector values = Vector::Zero(static_cast<Index>(places.size()));
  for (std::size_t i = first; i < places.size(); ++i) {
    double value = std::pow(x / places[i], power);
    for (std::size_t j = first; j < places.size(); ++j) {
      if (j != i) value *= (x - places[j]) / (places[i] - places[j]);
    }
    values[static_cast<Index>(i)] = value;
  }
  return values;
}

}  // namespace

StepPolynomial::StepPolynomial(StepOperations& physics, const TimeRule& rule, double dt, const Collocation& y)
    : physics_(physics), rule_(rule), y_(y), dt_(dt) {}

double StepPolynomial::error(double time) const {
  // Any shape near that of the time does: only the corrections differ.
  NodeSolution shape = y_.first_order_node(y_.last());
  shape.time = time;
  NodeSolution former = shape;
  correct(former, Fit::later_nodes);
  Corrections moved, charged;
  for (const Fit fit : {Fit::nodes, Fit::nodes_and_rate}) {
    NodeSolution better = shape;
    correct(better, fit);
    const VisibleDifference change = physics_.visible_difference(former, better);
    moved.add(change.shape);
    charged.add(change.potential);
    former = std::move(better);
  }
  return std::max(moved.error_after(moved.count()), charged.error_after(charged.count()));
}

double StepPolynomial::error() const {
  const double before = rule_.nodes.size() > 1 ? rule_.nodes[rule_.nodes.size() - 2] : 0.0;
  return error(physics_.start().time + 0.5 * (before + rule_.nodes.back()) * dt_);
}

NodeSolution StepPolynomial::at(double time) const {
  NodeSolution result = physics_.first_order_step({time - physics_.start().time, NodeEnd::material});
  correct(result, Fit::nodes_and_rate);
  return result;
}

/// Adds what the polynomial says of the corrections at the time of a solution.
void StepPolynomial::correct(NodeSolution& solution, Fit fit) const {
  const Vector weights = weights_from_zero(rule_.nodes, (solution.time - physics_.start().time) / dt_, fit);
  for (std::size_t a = 0; a < solution.vesicles.size(); ++a) {
    SurfaceFields& fields = solution.vesicles[a].material;
    for (std::size_t m = 0; m <= y_.last(); ++m) {
      const SurfaceFields& from = y_.first_order_node(m).vesicles[a].material;
      const SurfaceFields& to = y_.node(m).vesicles[a].material;
      const double weight = weights[static_cast<Index>(m)];
      fields.position += weight * (to.position - from.position);
      fields.transmembrane_potential += weight * (to.transmembrane_potential - from.transmembrane_potential);
      fields.free_charge += weight * (to.free_charge - from.free_charge);
      fields.poration += weight * (to.poration - from.poration);
    }
    // A guess for what is solved anew.
    fields.tension = y_.node(y_.last()).vesicles[a].material.tension;
  }
}

}  // namespace vehd
