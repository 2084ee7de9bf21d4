#pragma once

#include "bie/runs/resumption.hpp"
#include "bie/runs/run_loop.hpp"
#include "tests/support/files.hpp"

namespace vehd::testing {

/// That of a run of the scene to its end, whose files are gone.
inline HistoryTable history_of(const Scene& scene) {
  const TemporaryDirectory directory;
  const RunPaths paths{directory / "run"};
  make_directory(paths.directory);
  RecordedRun run({scene, paths, std::nullopt});
  run.start();
  while (!run.simulation().at_end()) run.step();
  return HistoryTable(paths.history());
}

}  // namespace vehd::testing
