#pragma once

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "bie/runs/resumption.hpp"
#include "bie/runs/run_loop.hpp"
#include "tests/support/files.hpp"

namespace vehd::testing {

/// History of a run of the scene to its end; the files of the run are removed.
inline HistoryTable history_of(const Scene& scene) {
  const TemporaryDirectory directory;
  const RunPaths paths{directory / "run"};
  make_directory(paths.directory);
  RecordedRun run({scene, paths, std::nullopt});
  run.start();
  while (!run.simulation().at_end()) run.step();
  return HistoryTable(paths.history());
}

/// Index of the first row at a time, up to rounding; there must be one.
inline std::size_t row_at(const HistoryTable& history, double time) {
  const std::vector<double>& times = history.column("time");
  const auto found = std::ranges::find_if(times, [&](double t) { return std::abs(t - time) < 1e-9 * times.back(); });
  BOOST_TEST_REQUIRE((found != times.end()));
  return static_cast<std::size_t>(found - times.begin());
}

}  // namespace vehd::testing
