#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "bie/runs/session.hpp"
#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd::python {

/// State and fields of a simulation at one time. It looks at those of the simulation as long as they are there, and
/// takes them over, where they lie, when the simulation goes on: arrays on them stay what they are.
class Moment {
 public:
  /// Looks at what belongs to someone else, who calls `keep` before giving it up and stays as long as this looks.
  Moment(const State& state, const Fields& fields, std::shared_ptr<const void> owner)
      : state_(&state), fields_(&fields), owner_(std::move(owner)), time_(state.time) {}
  /// Owns both.
  Moment(State&& state, Fields&& fields) : time_(state.time) { keep(std::move(state), std::move(fields)); }
  Moment(const Moment&) = delete;
  Moment& operator=(const Moment&) = delete;

  [[nodiscard]] double time() const { return time_; }
  /// Takes over what it looks at.
  void keep(State&& state, Fields&& fields) {
    const std::lock_guard lock(mutex_);
    for (VesicleState& vesicle : state.vesicles) vesicle.recycled = {};
    own_state_ = std::move(state);
    own_fields_ = std::move(fields);
    state_ = &own_state_;
    fields_ = &own_fields_;
    owner_.reset();
  }
  /// @returns what `look(state, fields)` does; nobody takes anything over meanwhile
  template <typename Look>
  auto with(const Look& look) const {
    const std::lock_guard lock(mutex_);
    return look(*state_, *fields_);
  }

 private:
  const State* state_ = nullptr;
  const Fields* fields_ = nullptr;
  std::shared_ptr<const void> owner_;  ///< of what it looks at
  double time_;
  State own_state_;
  Fields own_fields_;
  mutable std::mutex mutex_;  // a step runs beside other threads of Python
};

/// A scene with where it comes from.
struct GivenScene {
  SceneSource source;  ///< of text: a file that need not exist
  Scene scene;
};

/// A scene that is simulated step by step, in memory or with the files of a run.
class SceneRun {
 public:
  /// @param directory  of the run; absent: no files
  /// @param resume     whether a former run there may go on
  /// @throws InputError, OutputError, ConvergenceError as `vehd run`
  SceneRun(const GivenScene& given, const std::optional<std::filesystem::path>& directory, bool resume);
  /// Leaves the files of a run that did not reach its end as Ctrl-C does.
  ~SceneRun();
  SceneRun(const SceneRun&) = delete;
  SceneRun& operator=(const SceneRun&) = delete;

  /// One accepted step. @returns false where the end is reached already
  /// @throws ConvergenceError where none is acceptable: the state is the last good one
  bool step();
  /// Adds a snapshot of the present state to the files unless it has one, and brings them up to date.
  /// @throws InputError if there are no files, std::runtime_error if the run is closed
  void snapshot();
  /// Adds a snapshot as snapshot() does, writes the summary and leaves the directory; no step can follow.
  void close();

  [[nodiscard]] bool completed() const;
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] RunStatus status() const;
  [[nodiscard]] const Simulation& simulation() const;
  [[nodiscard]] const std::optional<std::filesystem::path>& directory() const { return directory_; }
  /// In the axes of the laboratory.
  [[nodiscard]] std::shared_ptr<Moment> moment();
  /// Rows of all vesicles, as in history.csv.
  [[nodiscard]] HistoryTable history() const;
  /// Rows of each, as in vesicles.csv; those of history.csv where there is one vesicle.
  [[nodiscard]] HistoryTable vesicle_history() const;

 private:
  [[nodiscard]] bool at_end() const { return simulation().at_end(); }
  void start();
  void append_rows();
  void end(const RunOutcome& outcome);
  void require_idle() const;
  /// A forked process has the simulation as well, but the files are those of the process that began it.
  [[nodiscard]] bool has_own_files() const { return getpid() == process_; }
  void require_own_files() const;

  /// Members that a view of a state may keep alive.
  struct Parts {
    explicit Parts(const Scene& given) : scene(given) {}
    Scene scene;
    std::optional<RunSession> session{};
    std::optional<RecordedRun> recorded{};
    std::optional<Simulation> in_memory{};
  };

  std::shared_ptr<Parts> parts_;
  std::optional<std::filesystem::path> directory_;
  std::optional<LabFrameOutput> lab_frame_output_;
  std::optional<HistoryTable> history_, vesicles_;
  std::shared_ptr<Moment> moment_;
  bool looks_ = false;  ///< the moment is that of the state
  bool closed_ = false;
  std::atomic<bool> busy_ = false;
  pid_t process_ = getpid();
};

}  // namespace vehd::python
