#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd {

/// Required end of a hard case: at its end time and trustworthy; at its end time with a verdict that names a fault;
/// before its end time, with a reason.
enum class ExpectedEnd { completed, flagged, stops };

/// A bound on one column of history.csv.
struct ColumnBound {
  std::string column;
  double bound;
};

/// A scene with its pass criterion, given at the top of the scene file in lines "#: key = value" (TOML): family, expect
/// (an ExpectedEnd), short_end_time, most (largest magnitudes of columns), falls (columns that never rise), steady
/// (largest relative changes of columns in the second half of the run). Area and volume may drift by 1e-6 unless the
/// file gives other bounds.
struct StabilityCase {
  std::string name;
  std::string family;
  Scene scene;
  double short_end_time = 0.0;
  ExpectedEnd expect = ExpectedEnd::completed;
  std::vector<ColumnBound> most;
  std::vector<std::string> falls;
  std::vector<ColumnBound> steady;
};

/// @throws InputError that names file and line
StabilityCase read_stability_case(const std::filesystem::path& path);

}  // namespace vehd
