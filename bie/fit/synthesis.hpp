#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bie/fit/experiment.hpp"
#include "bie/fit/model_runs.hpp"

namespace vehd {

/// Data to be made from a scene.
struct Synthesis {
  SceneSource source{};
  std::string quantity{};             ///< a column of history.csv, or "contour"
  std::string key{};                  ///< varied, "table.key"; empty: data against time, at the scene's snapshots
  std::vector<std::string> values{};  ///< of the key, "10 kHz"
  std::string noise{};                ///< standard deviation, "2 mV"
  std::string pixel{};                ///< of a contour, whose points come to the nearest pixel; empty: none
  int n_angles = 64;                  ///< of a contour
  std::uint64_t seed = 1;
};

/// The experiment that would measure these data, their deviations included. A pixel of side h adds h²/12 to the
/// variance of r.
/// @throws InputError naming the wrong option
Experiment experiment_of(const Synthesis& synthesis);

/// The model's values of an experiment, [experiment.data.size()], by runs with a tolerance of a hundredth of the noise;
/// a first set of runs finds how large the values are.
/// @throws InputError if a run does not reach its end; Interrupted, OutputError
Vector simulated_values(Experiment experiment, const RunWork& work, Interruption& interruption);

/// CSV of the model's values with noise: the abscissa, of a contour the angle, the quantity, its deviation.
/// @param prediction  simulated_values of `experiment`
std::string synthetic_data(const Synthesis& synthesis, const Experiment& experiment, const Vector& prediction);

}  // namespace vehd
