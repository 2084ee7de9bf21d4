#pragma once

#include <cstdint>
#include <vector>

#include "bie/estimate/cost_cache.hpp"
#include "bie/scene/scene.hpp"

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

/// From the cache; otherwise timed on the scene, at degrees that rise as long as the budget allows, and kept.
/// @param seconds  budget
/// @throws ConvergenceError where the first steps cannot be taken at any degree
CostModel cost_model_of(const Scene& scene, double seconds, CostCache& cache);

}  // namespace vehd
