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
  std::string toml;   ///< as of SceneSource::settings
  std::string shown;  ///< in tables: a text without its quotes
};

/// One key of a sweep and what it takes in turn.
struct VariedKey {
  std::string name;  ///< "table.key"
  std::vector<VariedValue> values;
  bool is_logarithmic = false;  ///< given from one value to another by equal factors
};

/// A column of history.csv that the table of a sweep shows.
struct SweepColumn {
  std::string name;
  std::string place{};  ///< "file:line" where it is asked for
};

/// How the values of several keys meet: each of one with each of the other, or the first ones together, the second ones
/// together ...
enum class SweepMode { grid, zip };

/// A sweep as its file gives it.
struct SweepFile {
  std::filesystem::path file;
  std::filesystem::path scene_file;
  Scene scene;  ///< without any of the values
  std::vector<VariedKey> keys;
  SweepMode mode = SweepMode::grid;
  std::vector<SweepColumn> columns;  ///< empty: the file names none

  /// Of the runs that it asks for; most_runs + 1 stands for all larger numbers.
  [[nodiscard]] std::size_t n_runs() const;
  /// The values of one run, one for each key. The last key of a grid changes first.
  [[nodiscard]] std::vector<VariedValue> values_of(std::size_t run) const;
};

/// Reads and validates a sweep (docs/sweeps.md) and its base scene. Every value is one that its key accepts; whether a
/// scene accepts it together with all others is found out when that scene is made.
/// @throws InputError "file:line: what is wrong, the value, what is accepted"
SweepFile read_sweep(const std::filesystem::path& path);

}  // namespace vehd
