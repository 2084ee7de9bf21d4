#include "bie/python/scene_run.hpp"

#include <stdexcept>
#include <utility>

#include "bie/runs/vesicle_rows.hpp"
#include "bie/support/errors.hpp"

namespace vehd::python {
namespace {

/// During its lifetime no other thread can step or read.
class Busy {
 public:
  explicit Busy(std::atomic<bool>& flag) : flag_(flag) {
    if (flag_.exchange(true)) throw std::runtime_error("another thread is stepping this simulation");
  }
  ~Busy() { flag_ = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  std::atomic<bool>& flag_;
};

}  // namespace

SceneRun::SceneRun(const GivenScene& given, const std::optional<std::filesystem::path>& directory, bool resume,
                   const std::filesystem::path& from)
    : parts_(std::make_shared<Parts>(given.scene)), directory_(directory) {
  if (!directory_ && parts_->scene.numerics.error_bars) {
    throw InputError("\"error_bars\" in [numerics] is true, but there is no directory for history_error.csv");
  }
  if (directory_) {
    parts_->session.emplace(parts_->scene, given.source, *directory_, resume, Ranks(), false, from);
    if (parts_->session->is_complete()) {
      // No step is left, and no file has to be written.
      const RunTask task = parts_->session->task({});
      parts_->in_memory.emplace(parts_->scene, *task.checkpoint, OutputUnits(parts_->scene));
      parts_->in_memory->start();
      closed_ = true;
      parts_->session->leave();
    } else {
      parts_->recorded.emplace(parts_->session->task({}));
      start();
    }
  } else {
    parts_->in_memory.emplace(parts_->scene, Checkpoint{}, OutputUnits(parts_->scene));
    lab_frame_output_.emplace(parts_->in_memory->problem().frame, parts_->in_memory->problem().settings);
    const bool several = parts_->in_memory->evolution().state().vesicles.size() > 1;
    const HistoryKind kind = history_kind(parts_->scene);
    history_.emplace(parts_->in_memory->units(), kind);
    if (several) vesicles_.emplace(parts_->in_memory->units(), of_each_like(kind));
    start();
  }
}

SceneRun::~SceneRun() {
  try {
    if (has_own_files()) close();
  } catch (const std::exception&) {
    // The checkpoint of the last step exists, and a destructor cannot report the error.
  }
}

const Simulation& SceneRun::simulation() const {
  return parts_->recorded ? parts_->recorded->simulation() : *parts_->in_memory;
}

void SceneRun::start() {
  Simulation& simulation = parts_->recorded ? parts_->recorded->simulation() : *parts_->in_memory;
  if (parts_->recorded) {
    parts_->recorded->start();
    if (at_end()) end({.completed = true, .reason = {}});
  } else {
    simulation.start();
    append_rows();
  }
  simulation.keep_former([this](State&& state, Evaluation&& evaluation) {
    if (!view_is_live_) return;
    view_is_live_ = false;
    if (moment_.use_count() > 1) moment_->keep(std::move(state), std::move(evaluation.fields));
    moment_.reset();
  });
}

bool SceneRun::step() {
  const Busy busy(busy_);
  if (at_end()) return false;
  require_own_files();
  if (closed_) throw std::runtime_error("the simulation is closed");
  moment_ = view_is_live_ ? std::move(moment_) : nullptr;
  if (!parts_->recorded) {
    parts_->in_memory->step();
    append_rows();
    return true;
  }
  try {
    parts_->recorded->step();
  } catch (const ConvergenceError& error) {
    end(parts_->recorded->failed(error));
    throw;
  }
  if (at_end()) end({.completed = true, .reason = {}});
  return true;
}

void SceneRun::append_rows() {
  for (const RecordedSide& side : parts_->in_memory->sides()) {
    const HistoryRow row = row_in_laboratory(*lab_frame_output_, parts_->scene.numerics.order, side);
    history_->append(vesicles_ ? row_of_all(row) : row);
    if (!vesicles_) continue;
    for (const HistoryRow& own : rows_of_each(row)) vesicles_->append(own);
  }
}

void SceneRun::snapshot() {
  const Busy busy(busy_);
  if (!directory_) throw InputError("a simulation in memory has no file for a snapshot: give it a directory");
  require_own_files();
  if (closed_) throw std::runtime_error("the simulation is closed");
  parts_->recorded->snapshot();
}

void SceneRun::close() {
  const Busy busy(busy_);
  if (closed_) return;
  require_own_files();
  if (parts_->recorded) parts_->recorded->snapshot();
  const std::string now = simulation().time_text(simulation().evolution().state().time);
  end({.completed = at_end(), .reason = at_end() ? std::string() : "stopped from Python at time " + now});
}

void SceneRun::end(const RunOutcome& outcome) {
  if (closed_) return;
  closed_ = true;
  if (!parts_->recorded) return;
  parts_->recorded->end(outcome);
  static_cast<void>(parts_->session->summarise(outcome));
  parts_->session->leave();
}

bool SceneRun::completed() const {
  require_idle();
  return at_end();
}

void SceneRun::require_own_files() const {
  if (directory_ && !has_own_files()) {
    throw std::runtime_error("the files of this simulation belong to the process that this one was forked from");
  }
}

void SceneRun::require_idle() const {
  if (busy_) throw std::runtime_error("another thread is stepping this simulation");
}

RunStatus SceneRun::status() const {
  require_idle();
  return simulation().status();
}

std::shared_ptr<StateView> SceneRun::moment() {
  require_idle();
  if (moment_) return moment_;
  const State& state = simulation().evolution().state();
  const Fields& fields = simulation().evolution().evaluation().fields;
  const Frame& frame = simulation().problem().frame;
  view_is_live_ = frame.is_laboratory();
  moment_ = view_is_live_ ? std::make_shared<StateView>(state, fields, parts_)
                          : std::make_shared<StateView>(in_laboratory(frame, state), in_laboratory(frame, fields));
  return moment_;
}

HistoryTable SceneRun::history() const {
  require_idle();
  return directory_ ? HistoryTable(RunPaths{*directory_}.history()) : *history_;
}

HistoryTable SceneRun::vesicle_history() const {
  require_idle();
  if (simulation().evolution().state().vesicles.size() == 1) return history();
  return directory_ ? HistoryTable(RunPaths{*directory_}.vesicles()) : *vesicles_;
}

}  // namespace vehd::python
