#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd {

/// Most runs of one sweep.
constexpr std::size_t most_runs = 100000;

/// One value that a sweep gives to a key.
struct VariedValue {
  std::string toml;   ///< as in SceneSource::settings
  std::string shown;  ///< in tables: a text without its quotes
};

/// One key of a sweep and its values.
struct VariedKey {
  std::string name;  ///< "table.key"
  std::vector<VariedValue> values;
  bool is_logarithmic = false;  ///< values are spaced by equal factors
};

/// A column of history.csv that the table of a sweep shows.
struct SweepColumn {
  std::string name;
  std::string place{};  ///< "file:line" of the request
};

/// How the values of several keys are combined: every value of one with every value of the others, or all first values
/// together, all second values together, …
enum class SweepMode { grid, zip };

/// Contents of a sweep file.
struct SweepFile {
  std::filesystem::path file;
  std::filesystem::path scene_file;
  Scene scene;  ///< base scene, without any of the values
  std::vector<VariedKey> keys;
  SweepMode mode = SweepMode::grid;
  std::vector<SweepColumn> columns;  ///< empty: the file names none

  /// Number of runs; most_runs + 1 stands for all larger numbers.
  [[nodiscard]] std::size_t n_runs() const;
  /// The values of one run, one for each key. The last key of a grid changes fastest.
  [[nodiscard]] std::vector<VariedValue> values_of(std::size_t run) const;
};

/// Reads and validates a sweep (docs/sweeps.md) and its base scene. Every value is checked against its key;
/// combinations of values are checked when their scenes are read.
/// @throws InputError "file:line: what is wrong, the value, what is accepted"
SweepFile read_sweep(const std::filesystem::path& path);

}  // namespace vehd
