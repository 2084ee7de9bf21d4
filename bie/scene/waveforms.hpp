#pragma once

#include <string_view>
#include <vector>

#include "bie/physics/waveform.hpp"
#include "bie/scene/scene.hpp"

/// Time dependence of flow, field and pump.
namespace vehd {

/// Least number of steps in a period with a tolerance: with steps near a whole period the forcing would look constant.
constexpr double fewest_steps_a_period = 8.0;

/// The factor as a function of time.
/// @throws InputError for a waveform that no valid scene has
Waveform waveform_of(const WaveformScene& waveform);

/// A waveform that the steps of a run must resolve.
struct ActingWaveform {
  std::string_view table;  ///< table of its keys
  WaveformScene waveform;
};

/// The waveforms of a scene of one vesicle. A field, flow or pump that is 0 has none. An averaged field has the
/// waveform of its amplitude: none, or a pulse as long as the burst.
std::vector<ActingWaveform> acting_waveforms(const Scene& scene);

/// Lower bound on the steps that a run takes until `end` because of the waveform: fewest_steps_a_period per period and
/// one for each discontinuity, two for a jump of a table.
double fewest_steps(const WaveformScene& waveform, double end);

}  // namespace vehd
