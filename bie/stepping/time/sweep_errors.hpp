#pragma once

#include <algorithm>
#include <cstddef>

#include "bie/stepping/thresholds.hpp"
#include "bie/stepping/time/corrections.hpp"
#include "bie/stepping/time/step_operations.hpp"

namespace vehd {

/// Of shape and V_m.
inline double largest_of(const VisibleDifference& error) { return std::max(error.shape, error.potential); }

/// The larger one of shape and V_m, each as many times as it counts.
inline double weighted(const VisibleDifference& weights, const VisibleDifference& error) {
  return std::max(weights.shape * error.shape, weights.potential * error.potential);
}

/// What the sweeps so far have changed of all that counts, each as many times as it does.
class SweepErrors {
 public:
  /// @param least  sweeps of shape and V_m are not believed to contract more than this
  SweepErrors(const VisibleDifference& weights, double telling, double least)
      : weights_(weights), telling_(telling), least_(least) {}
  /// Of the shape and V_m by a sweep.
  void add(const VisibleDifference& change) {
    shape_.add(weights_.shape * change.shape);
    potential_.add(weights_.potential * change.potential);
  }
  /// Of tension and charge, each by the sweep before.
  void add(const InstantaneousDifference& change) {
    tension_.add(change.tension);
    charge_.add(change.charge);
  }
  /// Largest of these errors of shape and V_m, each as many times as it counts, and of what they make of tension and
  /// charge.
  /// @param least  see magnification
  [[nodiscard]] double lasting_or_magnified(const VisibleDifference& error, double least) const {
    return std::max(weighted(weights_, error), magnification(least) * largest_of(error));
  }
  [[nodiscard]] int sweeps() const { return static_cast<int>(shape_.count()); }
  /// Whether tension and charge are known after the last sweep as well.
  [[nodiscard]] bool all_known() const { return tension_.count() == shape_.count(); }
  /// Estimated error of shape and V_m after the last sweep.
  [[nodiscard]] double visible_error() const {
    return std::max(error_of(shape_, shape_.count()), error_of(potential_, potential_.count()));
  }
  /// Of all after sweep j = 1, 2, …, whether it was made or not.
  /// @param least  sweeps whose changes of tension and charge are not known are not supposed to contract more than this
  [[nodiscard]] double error_after(int sweep, double least = thresholds::best_contraction) const {
    const auto j = static_cast<std::size_t>(sweep);
    const auto supposed = [&](const Corrections& changes) {
      return changes.count() > 1 ? std::max(changes.contraction(), least) : least;
    };
    const VisibleDifference visible{error_of(shape_, j) / weights_.shape, error_of(potential_, j) / weights_.potential};
    return std::max({lasting_or_magnified(visible, telling_), tension_.error_after(j, supposed(tension_)),
                     charge_.error_after(j, supposed(charge_))});
  }
  /// Of all after sweep j, one that was not made yet, if sweeps go on to contract as the last one did, however much
  /// that was; tension and charge as what they follow from where they are known of one sweep alone.
  [[nodiscard]] double hoped_error_after(int sweep) const {
    const auto j = static_cast<std::size_t>(sweep);
    Corrections visible;
    for (std::size_t k = 1; k <= shape_.count(); ++k) visible.add(std::max(shape_.change(k), potential_.change(k)));
    const auto hoped = [&](const Corrections& changes) {
      return changes.error_after(j, (changes.count() > 1 ? changes : visible).measured_contraction());
    };
    return std::max({hoped(visible), hoped(tension_), hoped(charge_)});
  }
  /// By the last sweep.
  [[nodiscard]] VisibleDifference contraction() const {
    return {std::max(shape_.contraction(), least_), std::max(potential_.contraction(), least_)};
  }
  /// How much larger an error of tension or charge may be than that of shape and V_m it comes from: as in the sweep
  /// that has changed them the most times as much. The last ones change what the step leaves.
  /// @param least  what a sweep has to change of shape or V_m, as often as it counts, to tell
  [[nodiscard]] double magnification(double least) const {
    double largest = 1.0;
    for (std::size_t j = 1; j <= tension_.count(); ++j) {
      if (std::max(shape_.change(j), potential_.change(j)) < least) continue;
      const double visible = std::max(shape_.change(j) / weights_.shape, potential_.change(j) / weights_.potential);
      largest = std::max(largest, std::max(tension_.change(j), charge_.change(j)) / visible);
    }
    return std::min(largest, thresholds::most_magnification);
  }

 private:
  [[nodiscard]] double error_of(const Corrections& changes, std::size_t j) const {
    return changes.error_after(j, std::max(changes.contraction(), least_));
  }

  VisibleDifference weights_;
  double telling_, least_;
  Corrections shape_, potential_, tension_, charge_;
};

}  // namespace vehd
