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
  SceneSource source;               ///< of its scene: the base scene and settings
  std::optional<Scene> scene;       ///< absent: refused
  std::string refusal;              ///< why
  std::string name;                 ///< of its directory: of the effective scene; empty of one that is refused
};

/// 16 hexadecimal digits that belong to a text: its CRC-32 and its Adler-32. Two of a million different scenes have the
/// same with a probability of about one in a hundred; the run of the one would then refuse the other.
/// Source: zlib
std::string hash_of(const std::string& text);

/// The runs that a sweep asks for, in the order of its table; every scene is made and checked.
std::vector<SweepRun> runs_of(const SweepFile& sweep);

/// Columns that the table of a sweep shows of the last row of each history: those that its file names, or time, reduced
/// volume, aspect ratio, inclination and bending energy.
/// @throws InputError "file:line: ..." where a history of the base scene has no such column
std::vector<HistoryColumn> columns_of(const SweepFile& sweep);

}  // namespace vehd
