#include "bie/stepping/time/next_step.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "bie/stepping/thresholds.hpp"

namespace vehd {

int fewest_sweeps(int order) { return std::min(2, order - 1); }

double size_factor(double error, double allowed, int power) {
  if (error <= 0.0) return thresholds::most_step_factor;
  const double factor = thresholds::step_safety * std::pow(allowed / error, 1.0 / power);
  return std::clamp(factor, thresholds::least_step_factor, thresholds::most_step_factor);
}

namespace {

/// What steps that begin in one way cost.
struct Offer {
  double factor = thresholds::least_step_factor;
  double cost = std::numeric_limits<double>::infinity();
};

/// @param after   errors after sweep 1, 2, …; empty: not known, and nothing is offered
/// @param power   after sweep j they fall like dt^(j + power)
/// @param before  evaluations before the first sweep
Offer best_offer(const std::vector<double>& after, double allowed, int power, double before, int n_nodes) {
  Offer best;
  if (after.empty()) return best;
  const int order = static_cast<int>(std::ssize(after)) + 1;
  for (int j = fewest_sweeps(order); j < order; ++j) {
    const double factor = size_factor(after[static_cast<std::size_t>(j - 1)], allowed, j + power);
    const double cost = (before + n_nodes * j) / factor;
    if (cost < best.cost) best = {factor, cost};
  }
  return best;
}

/// Errors after each sweep of a step of this size that begins afresh, by the last that did; empty where none is known.
std::vector<double> errors_afresh(const StepErrors& errors, const Past& past, double dt) {
  std::vector<double> result;
  if (past.afresh_errors.size() != std::ssize(errors.after)) return result;
  for (Index i = 0; i < past.afresh_errors.size(); ++i) {
    const double contracted = past.afresh_errors[i] * std::pow(dt / past.afresh_dt, static_cast<double>(i + 1));
    result.push_back(errors.of_explicit_step * contracted);
  }
  return result;
}

std::vector<double> times(double factor, std::vector<double> errors) {
  for (double& error : errors) error *= factor;
  return errors;
}

}  // namespace

NextStep next_step(const StepErrors& errors, const Past& past, double dt, int n_nodes, Beginning beginning,
                   bool accepted) {
  constexpr double kRate = 1.0, kFirstOrderSteps = 1.0;
  const bool begins_afresh = beginning == Beginning::afresh;
  NextStep result{1.0, Beginning::afresh, past.afresh_dt, past.afresh_errors};
  if (begins_afresh && accepted && errors.of_explicit_step > 0.0) {
    result.afresh_dt = dt;
    result.afresh_errors = Eigen::Map<const Vector>(errors.after.data(), std::ssize(errors.after));
    result.afresh_errors /= errors.of_explicit_step;
  }
  const Offer afresh = best_offer(begins_afresh ? errors.after : errors_afresh(errors, past, dt), errors.allowed, 1,
                                  kRate + kFirstOrderSteps, n_nodes);
  result.factor = afresh.factor;
  if (!errors.of_past || (begins_afresh && (!accepted || !(errors.of_explicit_step > 0.0)))) return result;
  const double begun_with = begins_afresh ? *errors.of_past / errors.of_explicit_step : 1.0;
  const Offer with_past = best_offer(times(begun_with, errors.after), errors.allowed, n_nodes + 1, kRate, n_nodes);
  if (with_past.cost < thresholds::worthwhile_past * afresh.cost) {
    result.factor = std::min(with_past.factor, thresholds::longest_continuation);
    result.beginning = Beginning::with_past;
  }
  return result;
}

}  // namespace vehd
