#pragma once

#include <filesystem>
#include <string>

#include "bie/runs/checkpoint.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/scene/scene.hpp"
#include "bie/scene/settings.hpp"

/// Which changes of the scene are accepted when a run is resumed or continued.
namespace vehd {

/// Requires that the physics of a run are unchanged. [numerics] and [output] may change, except for output.units, a
/// symmetry that was off, an end in the past and, with error bars, the numerics of a run that has taken a step.
/// @param source  source of the scene, for messages
/// @throws InputError naming file and line of the scene, the key and both its values
void require_same_physics(const Scene& scene, const SceneSource& source, const Checkpoint& checkpoint,
                          const RunPaths& paths);

/// Start of a run that continues another one from its last state and time with another flow, field or waveform. Frame
/// and symmetry are those of that state in the new scene; its steps are chosen as at a start.
/// @param run  run that is continued; it may still be running
/// @throws InputError naming file and line of the scene, the key and both its values if another key differs; if that
/// run has taken no step, or is already past the end of the scene
Checkpoint continued_from(const RunPaths& run, const Scene& scene, const SceneSource& source);

/// A scene with the reference scales of the run that it continues where its [units] omit them, as scales derived from
/// other values change with the field and the flow. Unchanged if the directory has no run.
SceneSource in_scales_of(SceneSource source, const RunPaths& run);

/// Checkpoint from which a run resumes with the numerics of the scene, every change recorded. It is unchanged if the
/// scene is and there is a row. Otherwise, before the first step the run starts again from the scene; later the state
/// is truncated or continued by zeros to the required degree, steps are chosen as at a start, and recycled subspaces of
/// another degree or symmetry are dropped.
Checkpoint continued(Checkpoint checkpoint, const Scene& scene, const RunPaths& paths);

/// Degree and grid of run.h5: the highest that any session of the run has requested, so that nothing is truncated.
/// @throws InputError if the run has snapshots and their file cannot be read
int order_of_files(const Scene& scene, const Checkpoint& checkpoint, const RunPaths& paths);

/// "change dt (now 0.05), degree (now 16) ... in [numerics]": advice if no step is acceptable.
std::string advice_after_failure(const NumericsScene& numerics);

}  // namespace vehd
