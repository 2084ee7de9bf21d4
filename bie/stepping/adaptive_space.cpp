#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/stepping/evolution.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

// Adaptation of degree and quadrature to the state.
namespace vehd {

namespace {

/// The degree falls to one whose truncation error is below this share of its target, low enough that the degree does
/// not rise again at once.
constexpr double coarsening_truncation = 0.1;
/// The quadrature is coarsened if its error is below this share of its tolerance: a coarser level loses two digits.
constexpr double coarsening_quadrature = 1e-2;
/// Steps between two attempts to coarsen, so that attempts that always fail cost little of a run.
constexpr std::int64_t coarsening_interval = 4;

}  // namespace

int Evolution::lowest_order() const { return std::min(lowest_adaptive_order, setup_.settings.order); }

double Evolution::truncation_target() const {
  return thresholds::truncation_share * setup_.control.tolerance / growth_;
}

void Evolution::coarsen_quadrature(std::size_t a) {
  const std::int64_t level = state_.vesicles[a].quadrature_level;
  if (level == 0) return;
  const double error = evaluation_.diagnostics.vesicles[a].quadrature_error;
  if (error > coarsening_quadrature * setup_.settings.quadrature_tolerance) return;
  change_space(a, order(a), level - 1);
}

/// Is the truncation error below its target, or is there no higher degree?
bool Evolution::resolves(const Resolution& resolution, std::size_t a) const {
  return !adapts() || order(a) >= setup_.settings.order || resolution.remainder() <= truncation_target();
}

SmallestGap Evolution::smallest_gap(const State& state) const {
  return find_smallest_gap(state, discretisation_, setup_.model.wall, setup_.control.tolerance);
}

/// The least even degree that resolves the gaps about a vesicle; 0 with a fixed degree.
int Evolution::order_of_gap(const SmallestGap& gap, std::size_t a) const {
  if (!adapts()) return 0;
  // The degree of an image is that of its original, whatever the rounding.
  const double degree = std::min(gap.degrees[setup_.symmetry.exchange.original(a)], 1e3);
  return std::min(setup_.settings.order, 2 * static_cast<int>(std::ceil(degree / 2.0)));
}

int Evolution::raised_order(const Resolution& resolution, std::size_t a) const {
  const int enough = resolution.order_for(truncation_target(), order(a), order(a) + 8);
  return std::min(setup_.settings.order, std::max(enough, order(a) + thresholds::least_raise));
}

/// Raises the degree to one that resolves the reached state. @throws ConvergenceError; the vesicle is then unchanged
void Evolution::raise_order(std::size_t a, const Resolution& reached, int enough) {
  try {
    change_space(a, enough, state_.vesicles[a].quadrature_level);
  } catch (const ConvergenceError& error) {
    throw ConvergenceError(fmt::format("degree {} leaves out {:.1e}, accepted: {:.1e}, and degree {} fails: {}",
                                       order(a), reached.remainder(), truncation_target(), enough, error.what()));
  }
}

/// @param raised  vesicles whose degree has risen for this step: once per step, and again in the next one if necessary
/// @returns whether any degree was too low
bool Evolution::raise_orders_for(const StepAttempt& attempt, std::vector<bool>& raised) {
  if (!adapts()) return false;
  const SmallestGap gap = smallest_gap(attempt.state);
  bool any = false;
  for (std::size_t a = 0; a < raised.size(); ++a) {
    if (raised[a] || setup_.symmetry.exchange.is_image(a) || order(a) >= setup_.settings.order) continue;
    const Resolution found = resolution(attempt.state, a);
    const int of_gap = order_of_gap(gap, a);
    // The degree is also too low if it does not represent the same surface on another grid.
    const bool enough = resolves(found, a) && attempt.arrival_shifts[a] <= truncation_target();
    if (enough && order(a) >= of_gap) continue;
    raise_order(a, found, std::max(enough ? 0 : raised_order(found, a), of_gap));
    raised[a] = any = true;
  }
  return any;
}

void Evolution::coarsen_order(std::size_t a) {
  const int lowest = std::max(lowest_order(), order_of_gap(gap_, a));
  if (!adapts() || order(a) <= lowest) return;
  const double target = coarsening_truncation * truncation_target();
  const int highest = order(a) - 2 * thresholds::least_raise;
  // The visible share is that of the upper half of the degrees, which are other degrees after truncation.
  const auto suffices = [&](int order) {
    State cut = state_;
    cut.vesicles[a] = resized(std::move(cut.vesicles[a]), order);
    return resolution(cut, a).remainder() <= target;
  };
  int enough = resolution(state_, a).order_for(target, lowest, order(a));
  while (enough <= highest && !suffices(enough)) enough += thresholds::least_raise;
  if (enough <= highest) change_space(a, enough, state_.vesicles[a].quadrature_level);
}

void Evolution::try_to_coarsen(Coarsening coarsening, std::size_t a) {
  try {
    (this->*coarsening)(a);
  } catch (const ConvergenceError&) {
    // If the solves fail, degree and quadrature stay as they are.
  }
}

void Evolution::coarsen() {
  if (state_.step % coarsening_interval != 0) return;
  for (std::size_t a = 0; a < state_.vesicles.size(); ++a) {
    if (setup_.symmetry.exchange.is_image(a)) continue;
    try_to_coarsen(&Evolution::coarsen_order, a);
    try_to_coarsen(&Evolution::coarsen_quadrature, a);
  }
}

}  // namespace vehd
