#include <algorithm>
#include <cmath>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/first_step.hpp"
#include "bie/stepping/state/exchange.hpp"
#include "bie/stepping/state/resized.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/stepping/time/rate.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

std::vector<int> Evolution::starting_orders(const std::vector<StartMembrane>& start) const {
  std::vector<int> orders;
  for (const StartMembrane& membrane : start) {
    if (!adapts()) {
      orders.push_back(setup_.settings.order);
      continue;
    }
    const Matrix& position = membrane.position;
    const Vector& potential = membrane.potential.given;
    VesicleState shape;
    shape.position = position;
    shape.material = membrane.material;
    for_each_property(shape.material, [&](Vector& property) {
      property = resize_order(Matrix(property), order_of(position.rows())).col(0);
    });
    if (potential.size() > 0) shape.transmembrane_potential = resize_order(potential, order_of(position.rows()));
    // Exact for a sphere, and only a scale.
    shape.reference_area = position.bottomRows(position.rows() - 1).squaredNorm();
    orders.push_back(
        Resolution(setup_.model, shape).order_for(truncation_target(), lowest_order(), setup_.settings.order));
  }
  return orders;
}

/// Of a start whose charge, which moves V_m, or tension need more than its shape and V_m do: a spectrum that is cut too
/// early says little of how many degrees more. An ellipsoid has degree 1. Where more cannot be solved for, or change
/// nothing, everything stays: a step may raise the degree later. @returns whether any rose
bool Evolution::raise_orders_for_fields() {
  if (!adapts()) return false;
  std::vector<int> orders;
  bool raised = false;
  for (std::size_t a = 0; a < start_.size(); ++a) {
    orders.push_back(order(a));
    const bool has_tension = setup_.model.mobile && setup_.model.vesicles[a].inextensible;
    if ((!setup_.model.electric && !has_tension) || order(a) >= setup_.settings.order) continue;
    orders[a] = std::min(setup_.settings.order, order(a) + thresholds::least_raise);
    raised = true;
  }
  if (!raised) return false;
  const Discretisation discretisation = discretisation_;
  const State state = state_;
  const Evaluation evaluation = std::move(evaluation_);
  try {
    start_at(orders, start_);
    evaluation_ = {};
    arrive(state_);
    const Rate former = rate_of(evaluation), now = rate_of(evaluation_);
    if (instantaneous_difference(setup_.model, evaluation_, former, now).largest() > truncation_target()) return true;
  } catch (const ConvergenceError&) {
  }
  discretisation_ = discretisation;
  state_ = state;
  evaluation_ = evaluation;
  return false;
}

void Evolution::evaluate_start() {
  arrive(state_);
  while (raise_orders_for_fields()) {
  }
  start_.clear();
  if (state_.dt_next == 0.0) state_.dt_next = first_step(setup_, evaluation_, state_);
}

}  // namespace vehd
