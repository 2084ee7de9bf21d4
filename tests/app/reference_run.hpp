#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bie/support/types.hpp"
#include "tests/app/program.hpp"

/// All numbers of all snapshots, with their times and names.
std::vector<std::pair<std::string, vehd::Vector>> snapshot_data(const std::string& path);

/// History, snapshots and time series of two run directories agree bit for bit.
void check_same_run(const std::string& actual, const std::string& expected);

/// A complete short run to damage.
struct FinishedRun {
  TemporaryDirectory directory;
  std::string scene = directory / "scene.toml";
  std::string output = directory / "out";

  FinishedRun();
};

/// A scene, its run without any trouble, and the command that makes the same run in `output`, or continues it there.
struct ReferenceRun {
  TemporaryDirectory directory;
  std::string scene = directory / "scene.toml";
  std::string reference = directory / "reference";
  std::string output = directory / "out";
  std::vector<std::string> command = vehd_command({"run", scene, "-o", output, "--resume", "--no-plot", "--quiet"});
  double seconds = 0.0;

  explicit ReferenceRun(const std::string& text = quick_scene());

  /// Runs the command to its end and compares. It must succeed.
  void finish() const;

  /// Waits until the run has written at least one row.
  void wait_for_rows(RunningProgram& program) const;
};
