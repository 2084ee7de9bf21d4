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

/// State and fields of a simulation at one time. It refers to those of the simulation as long as they exist, and takes
/// over their storage when the simulation goes on, so that arrays that share it stay valid and unchanged.
class StateView {
 public:
  /// Refers to data of another object, kept alive by `owner`, which must call `keep` before it changes them.
  StateView(const State& state, const Fields& fields, std::shared_ptr<const void> owner)
      : state_(&state), fields_(&fields), owner_(std::move(owner)), time_(state.time) {}
  /// Owns both.
  StateView(State&& state, Fields&& fields) : time_(state.time) { keep(std::move(state), std::move(fields)); }
  StateView(const StateView&) = delete;
  StateView& operator=(const StateView&) = delete;

  [[nodiscard]] double time() const { return time_; }
  /// Takes over the data to which it refers.
  void keep(State&& state, Fields&& fields) {
    const std::lock_guard lock(mutex_);
    for (VesicleState& vesicle : state.vesicles) vesicle.recycled = {};
    own_state_ = std::move(state);
    own_fields_ = std::move(fields);
    state_ = &own_state_;
    fields_ = &own_fields_;
    owner_.reset();
  }
  /// @returns look(state, fields); the data are not taken over meanwhile
  template <typename Look>
  auto with(const Look& look) const {
    const std::lock_guard lock(mutex_);
    return look(*state_, *fields_);
  }

 private:
  const State* state_ = nullptr;
  const Fields* fields_ = nullptr;
  std::shared_ptr<const void> owner_;  ///< keeps the data alive to which it refers
  double time_;
  State own_state_;
  Fields own_fields_;
  mutable std::mutex mutex_;  // a step runs concurrently with other threads of Python
};

/// A scene and its source.
struct GivenScene {
  SceneSource source;  ///< of text: a file that need not exist
  Scene scene;
};

/// A scene that is simulated step by step, in memory or with the files of a run.
class SceneRun {
 public:
  /// @param directory  of the run; absent: no files
  /// @param resume     whether an earlier run there may be continued
  /// @throws InputError, OutputError, ConvergenceError as `vehd run`
  SceneRun(const GivenScene& given, const std::optional<std::filesystem::path>& directory, bool resume,
           const std::filesystem::path& from = {});
  /// Leaves the files of a run that did not reach its end in the state after Ctrl-C.
  ~SceneRun();
  SceneRun(const SceneRun&) = delete;
  SceneRun& operator=(const SceneRun&) = delete;

  /// Takes one accepted step. @returns false if the end has been reached before
  /// @throws ConvergenceError if no step is acceptable: the state is the last good one
  bool step();
  /// Adds a snapshot of the present state to the files unless they have it, and updates the files.
  /// @throws InputError if there are no files, std::runtime_error if the run is closed
  void snapshot();
  /// Adds a snapshot as snapshot() does, writes the summary and releases the directory; no step can follow.
  void close();

  [[nodiscard]] bool completed() const;
  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] RunStatus status() const;
  [[nodiscard]] const Simulation& simulation() const;
  [[nodiscard]] const std::optional<std::filesystem::path>& directory() const { return directory_; }
  /// State and fields in the axes of the laboratory.
  [[nodiscard]] std::shared_ptr<StateView> moment();
  /// Rows of all vesicles together, as in history.csv.
  [[nodiscard]] HistoryTable history() const;
  /// Rows of each vesicle, as in vesicles.csv; those of history.csv if there is one vesicle.
  [[nodiscard]] HistoryTable vesicle_history() const;

 private:
  [[nodiscard]] bool at_end() const { return simulation().at_end(); }
  void start();
  void append_rows();
  void end(const RunOutcome& outcome);
  void require_idle() const;
  /// A forked process has a copy of the simulation, but the files belong to the process that created it.
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
  std::shared_ptr<StateView> moment_;
  bool view_is_live_ = false;  ///< the moment refers to the state of the simulation
  bool closed_ = false;
  std::atomic<bool> busy_ = false;
  pid_t process_ = getpid();
};

}  // namespace vehd::python
