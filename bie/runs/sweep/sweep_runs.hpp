#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bie/runs/history.hpp"
#include "bie/scene/scene.hpp"
#include "bie/scene/settings.hpp"
#include "bie/scene/sweep_file.hpp"

namespace vehd {

/// One run of a sweep.
struct SweepRun {
  std::vector<VariedValue> values;  ///< one for each key
  SceneSource source;               ///< source of its scene: the base scene and settings
  std::optional<Scene> scene;       ///< absent: refused
  std::string refusal;              ///< why it is refused
  std::string name;                 ///< name of its directory, from the effective scene; empty if the run is refused
};

/// Hash of a text, 16 hexadecimal digits: its CRC-32 and its Adler-32. Among a million different scenes two have the
/// same hash with a probability of about one in a hundred; the run of one would then refuse the other.
/// Source: zlib
std::string hash_of(const std::string& text);

/// The runs of a sweep, in the order of its table; every scene is made and checked.
std::vector<SweepRun> runs_of(const SweepFile& sweep);

/// Columns of the table of a sweep, from the last row of each history: those that its file names, or time, reduced
/// volume, aspect ratio, inclination and bending energy; time and smallest gap with several vesicles.
/// @throws InputError "file:line: ..." if a history of the base scene has no such column
std::vector<HistoryColumn> columns_of(const SweepFile& sweep);

}  // namespace vehd
