#pragma once

#include <optional>
#include <vector>

#include "bie/estimate/cost_model.hpp"
#include "bie/estimate/cost_row.hpp"
#include "bie/estimate/stretch.hpp"
#include "bie/estimate/trial_run.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// What whole trial runs tell of tighter tolerances beside the steps of the last of them.
struct Trend {
  int degrees_per_digit = 4;    ///< that runs take, at most
  std::optional<double> order;  ///< in dt, at the steps of the trial runs; nothing: that of the scheme
};

/// From two trial runs, one after the other.
/// @param first  row of the first of all
Trend trend_of(const CostRow& first, const TrialRun& trial, const TrialRun& next);

/// All that predictions are made from.
struct Knowledge {
  const Scene& scene;
  const std::vector<double>& tolerances;  ///< for which the trial run knows degrees
  CostModel model;
  TrialRun trial{};  ///< the last one that says something
  Trend trend{};
  double ratio = 1.0;                ///< seconds of this scene to those of the model
  int starting_order = 0;            ///< of the tolerance that is predicted; 0: not known
  int known_start = 0;               ///< the last one that was measured; 0: none
  double start_tolerance = 0.0;      ///< of that one
  double sampled = 0.0;              ///< tolerance of the stretches; 0: there are none
  std::vector<Stretch> stretches{};  ///< of the tightest tolerance that has any, by their step

  void learn(TrialRun next);
  /// Tolerances of as many digits more take as many degrees more at the start.
  void expect_start(double tolerance);
  void learn_start(double tolerance, int order);
  void learn(double tolerance, std::vector<Stretch> of_trial);
};

/// Degree of a run with the tolerance of that index where each step of the trial run is.
std::vector<int> predicted_orders(const Knowledge& known, std::size_t index);

/// What starting_order takes at the tolerance of that index.
double start_seconds(const Knowledge& known, std::size_t index);

/// What one stretch with the tolerance of that index takes.
double stretch_seconds(const Knowledge& known, std::size_t index);

/// The cost table's row for the tolerance of that index, without files, from the steps of a trial run with a looser
/// one.
/// Accuracy: with stretches within a factor of 2 in steps and work (tests/estimate/prediction_test.cpp)
CostRow predicted_row(const Knowledge& known, std::size_t index);

}  // namespace vehd
