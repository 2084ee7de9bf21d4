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

/// A complete short run, to damage or to draw.
struct FinishedRun {
  TemporaryDirectory directory;
  std::string scene = directory / "scene.toml";
  std::string output = directory / "out";

  explicit FinishedRun(const std::string& text = quick_scene("0.5"));
};

/// A scene, a place for its run without any trouble, and the command that makes the same run in `output`, or continues
/// it there.
struct RunPair {
  TemporaryDirectory directory;
  std::string scene = directory / "scene.toml";
  std::string reference = directory / "reference";
  std::string output = directory / "out";
  std::vector<std::string> command =
      vehd_command({"run", scene, "-o", output, "--resume", "--no-plot", "--quiet", "--checkpoint-every", "0"});

  explicit RunPair(const std::string& text) { write_text(scene, text); }

  void run_reference() const;
  /// Begins the run that goes on later.
  void run_until(const std::string& end_time) const;
  /// Runs the command to its end and compares. It must succeed.
  void finish() const;
  /// Waits until the run has written at least one row.
  void wait_for_rows(RunningProgram& program) const;
};

/// With the run without trouble.
struct ReferenceRun : RunPair {
  double seconds = 0.0;  ///< that it took

  explicit ReferenceRun(const std::string& text = quick_scene());
};

/// Met while it runs on any machine: it has hours to go.
struct EndlessRun : RunPair {
  EndlessRun() : RunPair(quick_scene("100000.0")) {}

  /// Lets what was interrupted end soon, and compares it with the same run without trouble.
  void finish_soon() const;
};
