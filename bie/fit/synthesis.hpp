#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bie/fit/experiment.hpp"
#include "bie/fit/model_runs.hpp"

namespace vehd {

/// Description of synthetic data of a scene.
struct Synthesis {
  SceneSource source{};
  std::string quantity{};             ///< a column of history.csv, or "contour"
  std::string key{};                  ///< varied key, "table.key"; empty: data against time, at the scene's snapshots
  std::vector<std::string> values{};  ///< of the key, "10 kHz"
  std::string noise{};                ///< standard deviation, "2 mV"
  std::string pixel{};                ///< of a contour, whose points are moved to the nearest pixel; empty: none
  std::optional<int> n_angles{};      ///< of a contour; 64 if not given
  std::uint64_t seed = 1;
};

/// The experiment that would measure these data, including their deviations. A pixel of side h adds h²/12 to the
/// variance of r.
/// @throws InputError naming the wrong option
Experiment experiment_of(const Synthesis& synthesis);

/// Model values of an experiment, [experiment.data.size()], from runs with a tolerance of a hundredth of the noise. A
/// first set of runs determines the size of the values.
/// @throws InputError if a run does not reach its end or the noise needs a smaller tolerance than runs accept;
/// Interrupted, OutputError
Vector simulated_values(Experiment experiment, const RunWork& work, Interruption& interruption);

/// CSV of the model values with noise: abscissa, angle of a contour, quantity, deviation.
/// @param prediction  simulated_values of `experiment`, [n_data]
std::string synthetic_data(const Synthesis& synthesis, const Experiment& experiment, const Vector& prediction);

}  // namespace vehd
