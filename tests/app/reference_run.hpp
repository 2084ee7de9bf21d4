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

/// A scene, a folder for its undisturbed run, and the command that makes the same run in `output`, or continues it
/// there.
struct RunPair {
  TemporaryDirectory directory;
  std::string scene = directory / "scene.toml";
  std::string reference = directory / "reference";
  std::string output = directory / "out";
  std::vector<std::string> command =
      vehd_command({"run", scene, "-o", output, "--resume", "--no-plot", "--quiet", "--checkpoint-every", "0"});

  explicit RunPair(const std::string& text) { write_text(scene, text); }

  void run_reference() const;
  /// Begins the run, which is continued later.
  void run_until(const std::string& end_time) const;
  /// Runs the command to its end, which must succeed, and compares the result with the reference.
  void finish() const;
  /// Waits until the run has written at least one row.
  void wait_for_rows(RunningProgram& program) const;
};

/// A pair whose undisturbed run is made on construction.
struct ReferenceRun : RunPair {
  double seconds = 0.0;  ///< time taken by the undisturbed run

  explicit ReferenceRun(const std::string& text = quick_scene());
};

/// A run of hours, which is certain to be running when it is interrupted, on any machine.
struct EndlessRun : RunPair {
  EndlessRun() : RunPair(quick_scene("100000.0")) {}

  /// Continues the interrupted run to a nearby end, and compares it with the undisturbed run.
  void finish_soon() const;
};
