#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bie/scene/dimensionless_groups.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// A time of a scene: of an effect, of a waveform, of the run.
struct RunTime {
  std::string name, symbol;
  double value = 0.0;             ///< in the scale of the scene
  std::optional<double> seconds;  ///< if the scene gives the scale
  std::string meaning;            ///< what it means for the run, one line

  /// The value for display: "12 ms", or a plain number.
  [[nodiscard]] std::string text() const;
};

/// All times of a scene, shortest first.
/// @param groups  of the scene
std::vector<RunTime> run_times(const Scene& scene, const std::vector<DimensionlessGroup>& groups);

}  // namespace vehd
