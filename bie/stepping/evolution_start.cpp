#include <algorithm>
#include <cmath>
#include <limits>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/stepping/time/node_solution.hpp"
#include "bie/stepping/time/step_control.hpp"
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

/// Restarts at these degrees. If the solves fail or the restart is not needed, everything is unchanged: a step can
/// raise the degree later. @returns whether it has restarted
bool Evolution::restart_at(const std::vector<int>& orders,
                           const std::function<bool(const Evaluation& former)>& is_needed) {
  const Discretisation discretisation = discretisation_;
  const State state = state_;
  const SmallestGap gap = gap_;
  const Evaluation evaluation = std::move(evaluation_);
  try {
    start_at(orders, start_);
    evaluation_ = {};
    arrive(state_);
    if (is_needed(evaluation)) return true;
  } catch (const ConvergenceError&) {
  }
  discretisation_ = discretisation;
  state_ = state;
  gap_ = gap;
  evaluation_ = evaluation;
  return false;
}

/// Raises the degrees of the start if charge or tension change with them: these can need more degrees than shape and
/// V_m (an ellipsoid has degree 1), and a spectrum cut too early does not show how many. @returns whether any rose
bool Evolution::raise_orders_for_fields() {
  std::vector<int> orders;
  bool raised = false;
  for (std::size_t a = 0; a < start_.size(); ++a) {
    orders.push_back(order(a));
    const bool has_tension = setup_.model.mobile && setup_.model.vesicles[a].inextensible;
    const bool has_fields = setup_.model.electric || has_tension;
    if (!adapts() || !has_fields || order(a) >= setup_.settings.order) continue;
    orders[a] = std::min(setup_.settings.order, order(a) + thresholds::least_raise);
    raised = true;
  }
  return raised && restart_at(orders, [this](const Evaluation& former) {
           const Rate before = rate_of(former), now = rate_of(evaluation_);
           return instantaneous_difference(setup_.model, evaluation_, before, now).largest() > truncation_target();
         });
}

/// Raises the degrees of a compressed start, before its truncation error grows. @returns whether any rose
bool Evolution::raise_orders_for_growth() {
  if (start_.empty()) return false;
  expect_growth(std::numeric_limits<double>::infinity());
  std::vector<int> orders;
  bool raised = false;
  for (std::size_t a = 0; a < start_.size(); ++a) {
    orders.push_back(order(a));
    const Resolution found = resolution(state_, a);
    if (resolves(found, a)) continue;
    orders[a] = raised_order(found, a);
    raised = true;
  }
  return raised &&
         restart_at(with_images(setup_.symmetry.exchange, std::move(orders)), [](const Evaluation&) { return true; });
}

void Evolution::evaluate_start() {
  arrive(state_);
  while (raise_orders_for_fields()) {
  }
  while (raise_orders_for_growth()) {
  }
  start_.clear();
  if (state_.dt_next == 0.0) {
    state_.dt_next = first_step(setup_.control, setup_.settings.time_order, setup_.model, state_, evaluation_);
  }
}

}  // namespace vehd
