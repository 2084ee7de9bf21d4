#include "bie/stepping/time/step_polynomial.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "bie/stepping/time/corrections.hpp"

namespace vehd {

namespace {

/// Weights at x of the corrections of all nodes.
Vector weights_of(const std::vector<double>& nodes, double x, StepPolynomial::Fit fit) {
  const Vector all = Eigen::Map<const Vector>(nodes.data(), std::ssize(nodes));
  const Index first = fit == StepPolynomial::Fit::last_node                       ? all.size() - 1
                      : fit == StepPolynomial::Fit::later_nodes && all.size() > 1 ? 1
                                                                                  : 0;
  Vector weights = Vector::Zero(all.size());
  weights.tail(all.size() - first) =
      weights_from_zero(all.tail(all.size() - first), x, fit == StepPolynomial::Fit::nodes_and_rate ? 2 : 1);
  return weights;
}

}  // namespace

StepPolynomial::StepPolynomial(StepOperations& physics, const TimeRule& rule, double dt, const Collocation& y)
    : physics_(physics), rule_(rule), y_(y), dt_(dt) {}

std::vector<StepPolynomial::Fit> StepPolynomial::fits() const {
  if (y_.beginning() == Beginning::afresh) return {Fit::later_nodes, Fit::nodes, Fit::nodes_and_rate};
  return {Fit::last_node, Fit::later_nodes, Fit::nodes};
}

double StepPolynomial::error(double time) const {
  // Any shape near that of the time does: only the corrections differ.
  NodeSolution shape = y_.initial_node(y_.last());
  shape.time = time;
  const std::vector<Fit> all = fits();
  NodeSolution former = shape;
  correct(former, all.front());
  Corrections moved, charged;
  for (auto fit = all.begin() + 1; fit != all.end(); ++fit) {
    NodeSolution better = shape;
    correct(better, *fit);
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
  NodeSolution result = y_.initial(time);
  correct(result, fits().back());
  return result;
}

/// Adds what the polynomial says of the corrections at the time of a solution.
void StepPolynomial::correct(NodeSolution& solution, Fit fit) const {
  const Vector weights = weights_of(rule_.nodes, (solution.time - physics_.start().time) / dt_, fit);
  for (std::size_t a = 0; a < solution.vesicles.size(); ++a) {
    SurfaceFields& fields = solution.vesicles[a].material;
    for (std::size_t m = 0; m <= y_.last(); ++m) {
      const SurfaceFields& from = y_.initial_node(m).vesicles[a].material;
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
