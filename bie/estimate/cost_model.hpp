#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bie/estimate/cost_cache.hpp"
#include "bie/scene/scene.hpp"
#include "bie/support/deadline.hpp"

namespace vehd {

/// Seconds and memory against the degree, of all scenes with the same effects and the same symmetry.
/// Accuracy: an estimate; docs/digits.md compares predicted with measured seconds
class CostModel {
 public:
  /// One degree at which steps were timed.
  struct Point {
    int order = 0;
    double seconds = 0.0;  ///< per new shape: operators, solves and what else a step does with it
    double bytes = 0.0;    ///< most memory of the process
  };

  /// @param points  at least one, ascending
  explicit CostModel(std::vector<Point> points) : points_(std::move(points)) {}

  /// Between the points by power laws, beyond the last one by a power.
  [[nodiscard]] double seconds_per_shape(int order) const;
  /// Likewise of memory.
  [[nodiscard]] double bytes(int order) const;

 private:
  [[nodiscard]] double at(int order, double Point::*value, double growth) const;
  std::vector<Point> points_;
};

/// Steps of fixed size that are timed at one degree.
struct TimedSteps {
  std::optional<CostModel::Point> point;  ///< absent where the deadline came before the end of a step
  std::string stops;                      ///< why a step could not be taken; empty where none failed
};

/// Takes steps of a scene of fixed steps until its end, until there are so many or, after one at least, so many seconds
/// are over; those after the first two are timed, or all where there are no more.
TimedSteps timed_steps(const Scene& scene, int most_steps, double seconds, Deadline& deadline);

/// Calls time_at(order) at degrees that rise to a highest one, as long as the time that the next one is expected to
/// take is left of the budget.
/// @return  the degree that came last
int time_rising_degrees(int highest, double seconds, const std::function<void(int order)>& time_at);

/// From the cache; otherwise timed on the scene, which has steps to take, at degrees that rise as long as the budget
/// allows, and kept.
/// @param seconds  budget
/// @throws ConvergenceError, OutOfTime where the first steps cannot be taken at any degree
CostModel cost_model_of(const Scene& scene, double seconds, CostCache& cache, Deadline& deadline);

}  // namespace vehd
