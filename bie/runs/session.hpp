#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "bie/runs/checkpoint.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/runs/run_loop.hpp"
#include "bie/runs/scene_changes.hpp"
#include "bie/scene/scene.hpp"
#include "bie/scene/settings.hpp"

namespace vehd {

/// One session of a run: alone in the directory of the run, from where the last session has left it.
class RunSession {
 public:
  /// Creates the directory if it is missing. Nothing of a former run in it is touched yet.
  /// @param source  of the scene, for messages
  /// @param resume  whether a former run may go on
  /// @param ranks   that run it together: all calls are collective, and only the first rank writes
  /// @param is_claimed  the caller keeps other sessions out of the directory
  /// @param from     directory of the run that a new one continues; empty: none
  /// @throws InputError if another session is at it, or if what the directory holds cannot go on with this scene
  /// @throws OutputError if the directory cannot be used
  RunSession(Scene scene, const SceneSource& source, const std::filesystem::path& directory, bool resume,
             Ranks ranks = {}, bool is_claimed = false, const std::filesystem::path& from = {});

  [[nodiscard]] const RunPaths& paths() const { return paths_; }
  /// A former session has reached the end of the scene: nothing is left to do.
  [[nodiscard]] bool is_complete() const { return complete_; }
  /// Time that former sessions have computed.
  [[nodiscard]] double seconds_before() const { return checkpoint_ ? checkpoint_->totals.seconds : 0.0; }
  /// Changes of the scene since the last session.
  [[nodiscard]] std::vector<SceneChange> changes() const;

  /// The task of the session, which must outlive it.
  [[nodiscard]] RunTask task(TellStatus tell) const {
    return {scene_, paths_, checkpoint_, std::move(tell), {}, ranks_};
  }
  /// See `simulate`.
  /// @param checkpoint_lag  see RunTask
  RunOutcome simulate(Interruption& interruption, TellStatus tell,
                      std::chrono::milliseconds checkpoint_lag = longest_lag_of_files) const;

  /// Writes summary.json, on the first rank alone. @return its content
  /// @throws InputError, OutputError if files of the run are gone or the disk is full
  [[nodiscard]] nlohmann::json summarise(const RunOutcome& outcome) const;
  /// That of the last session.
  [[nodiscard]] nlohmann::json last_summary() const;
  /// Leaves the directory to other sessions: this one writes nothing any more.
  void leave() { lock_.reset(); }

 private:
  Scene scene_;
  RunPaths paths_;
  Ranks ranks_;
  std::unique_ptr<DirectoryLock> lock_;
  std::optional<Checkpoint> checkpoint_;
  std::size_t n_changes_before_ = 0;
  bool complete_ = false;
};

}  // namespace vehd
