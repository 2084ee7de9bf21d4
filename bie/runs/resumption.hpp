#pragma once

#include <filesystem>
#include <string>

#include "bie/runs/checkpoint.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/scene/scene.hpp"
#include "bie/scene/settings.hpp"

/// Changes of its scene that a session of a run accepts.
namespace vehd {

/// The physics of a run stay what they were; [numerics] and [output] may change, but for a symmetry that was switched
/// off and an end that lies in the past.
/// @param source  of the scene, for messages
/// @throws InputError naming file and line of the scene, the key and both its values
void require_same_physics(const Scene& scene, const SceneSource& source, const Checkpoint& checkpoint,
                          const RunPaths& paths);

/// The start of a run that continues another one from its last state, at its time, with another flow, field or
/// waveform. Frame and symmetry are those of that state under the new scene; its steps are chosen as at a start.
/// @param run  that is continued; it may still be running
/// @throws InputError naming file and line of the scene, the key and both its values where more differs; if that run
///         has taken no step, or ends later
Checkpoint continued_from(const RunPaths& run, const Scene& scene, const SceneSource& source);

/// A scene with the reference scales of the run that it continues, where its [units] leave them out: those that follow
/// from other values change with the field and the flow. One without a run in the directory stays as it is.
SceneSource in_scales_of(SceneSource source, const RunPaths& run);

/// The checkpoint from which a run goes on with the numerics of the scene, every change recorded. Where nothing has
/// changed it is the same; without a row yet, or with a change and no step, the run starts anew from the scene;
/// otherwise the state is cut or continued by zeros to the degree that is asked for, steps are chosen as at a start,
/// and what solves have learned in another degree or symmetry is forgotten.
Checkpoint continued(Checkpoint checkpoint, const Scene& scene, const RunPaths& paths);

/// Degree and grid of run.h5: the highest that any session of the run has asked for, so that nothing is cut.
/// @throws InputError if the run has snapshots and their file cannot be read
int order_of_files(const Scene& scene, const Checkpoint& checkpoint, const RunPaths& paths);

/// "change dt (now 0.05), degree (now 16) ... in [numerics]": what may help where no step is acceptable.
std::string what_may_help(const NumericsScene& numerics);

}  // namespace vehd
