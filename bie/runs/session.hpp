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

/// One session of a run: it has exclusive use of the directory and starts where the last session ended.
class RunSession {
 public:
  /// Creates the directory if it is missing. Files of an earlier run in it are not changed yet.
  /// @param source  source of the scene, for messages
  /// @param resume  whether an earlier run may be resumed
  /// @param ranks   ranks that run it together: all calls are collective, and only the first rank writes
  /// @param is_claimed  whether the caller keeps other sessions out of the directory
  /// @param from     directory of the run that a new one continues; empty: none
  /// @throws InputError if another session uses the directory, or if its run cannot be resumed with this scene
  /// @throws OutputError if the directory cannot be used
  RunSession(Scene scene, const SceneSource& source, const std::filesystem::path& directory, bool resume,
             Ranks ranks = {}, bool is_claimed = false, const std::filesystem::path& from = {});

  [[nodiscard]] const RunPaths& paths() const { return paths_; }
  /// Whether an earlier session has reached the end of the scene.
  [[nodiscard]] bool is_complete() const { return complete_; }
  /// Computing time of earlier sessions.
  [[nodiscard]] double seconds_before() const { return checkpoint_ ? checkpoint_->totals.seconds : 0.0; }
  /// Changes of the scene since the last session.
  [[nodiscard]] std::vector<SceneChange> changes() const;

  /// The task of the session, which must outlive it.
  [[nodiscard]] RunTask task(OnStatus on_status, std::chrono::milliseconds checkpoint_lag = {}) const {
    return {scene_, paths_, checkpoint_, std::move(on_status), ranks_, checkpoint_lag};
  }

  /// Writes summary.json, on the first rank only. @return its content
  /// @throws InputError, OutputError if files of the run are missing or the disk is full
  [[nodiscard]] nlohmann::json summarise(const RunOutcome& outcome) const;
  /// Summary of the last session.
  [[nodiscard]] nlohmann::json last_summary() const;
  /// Releases the directory for other sessions; this session writes nothing afterwards.
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
