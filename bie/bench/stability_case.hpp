#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd {

/// How a hard case has to end: at its end time and trustworthy; at its end time with a verdict that names what is not;
/// before its end, with a reason.
enum class ExpectedEnd { completed, flagged, stops };

/// A bound on one column of history.csv.
struct ColumnBound {
  std::string column;
  double bound;
};

/// A scene with its pass criterion, which stands at the top of the scene file in lines "#: key = value" (TOML):
/// family, expect (an ExpectedEnd), short_end_time, most (largest magnitudes of columns), falls (columns that never
/// rise), steady (largest relative changes of columns in the second half of the run). Without bounds of their own, area
/// and volume may drift by 1e-6.
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

/// @throws InputError naming file and line
StabilityCase read_stability_case(const std::filesystem::path& path);

}  // namespace vehd
