#pragma once

#include <string_view>
#include <vector>

#include "bie/physics/waveform.hpp"
#include "bie/scene/scene.hpp"

/// How what acts on a vesicle changes in time.
namespace vehd {

/// Steps of a period that a run with a tolerance takes at least: steps near a whole period would see nothing change.
constexpr double fewest_steps_a_period = 8.0;

/// The factor in the course of time.
/// @throws InputError of a waveform that no valid scene has
Waveform waveform_of(const WaveformScene& waveform);

/// A waveform that the steps of a run have to follow.
struct ActingWaveform {
  std::string_view table;  ///< of its keys
  WaveformScene waveform;
};

/// The waveforms of a scene of one vesicle. A field, flow or pump that is 0 has none. An averaged field has that of its
/// amplitude: none, or a pulse as long as a burst.
std::vector<ActingWaveform> acting_waveforms(const Scene& scene);

/// Steps that a run takes at least until that time because of the waveform, by arithmetic: fewest_steps_a_period a
/// period, and one to each discontinuity, which a jump of a table counts as two.
double fewest_steps(const WaveformScene& waveform, double end);

}  // namespace vehd
