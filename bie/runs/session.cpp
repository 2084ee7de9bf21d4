#include "bie/runs/session.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "bie/runs/history.hpp"
#include "bie/runs/resumption.hpp"
#include "bie/runs/run_files.hpp"
#include "bie/runs/summary.hpp"
#include "bie/runs/worst_error.hpp"
#include "bie/scene/problem.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

std::unique_ptr<DirectoryLock> lock_in(const RunPaths& paths) {
  make_directory(paths.directory);
  return std::make_unique<DirectoryLock>(paths.lock());
}

/// Whether a run has reached the end of the scene. Changes of its numerics do not matter then.
bool has_ended(const Scene& scene, const Checkpoint& checkpoint, const RunPaths& paths) {
  if (checkpoint.n_rows == 0 || checkpoint.state.time < scene.numerics.end_time) return false;
  ReadingNotes notes;
  const nlohmann::json summary = read_summary(paths.summary(), notes);
  return summary.is_object() && summary.value("completed", nlohmann::json()) == true;
}

/// Symmetry found at the start, which is imposed on all states of the run.
std::string imposed_symmetry(const Scene& scene, const std::optional<Origin>& origin) {
  const Problem problem = problem_of(scene, scene.numerics.order, origin ? &origin->state : nullptr);
  return symmetry_text(problem.symmetry, problem.frame);
}

/// Refuses to resume a run from another one than that which it continues.
void require_origin(const Checkpoint& checkpoint, const std::filesystem::path& from, const RunPaths& paths) {
  const std::string origin = checkpoint.origin ? checkpoint.origin->run : "";
  std::error_code ignored;
  if (from.empty() || std::filesystem::absolute(from).lexically_normal() == origin ||
      std::filesystem::equivalent(from, origin, ignored)) {
    return;
  }
  throw InputError(fmt::format("--from {}: the run in {} continues {}; accepted: that, or no --from", from.string(),
                               paths.directory.string(), origin.empty() ? "no other run" : origin));
}

}  // namespace

RunSession::RunSession(Scene scene, const SceneSource& source, const std::filesystem::path& directory, bool resume,
                       Ranks ranks, bool is_claimed, const std::filesystem::path& from)
    : scene_(std::move(scene)), paths_{directory}, ranks_(std::move(ranks)) {
  ranks_.collective([&] {
    if (ranks_.is_first() && !is_claimed) lock_ = lock_in(paths_);
  });
  if (!admit_run(paths_, resume)) {
    if (!from.empty()) checkpoint_ = continued_from({from}, scene_, source);
    return;
  }
  checkpoint_ = read_checkpoint(paths_.checkpoint());
  require_origin(*checkpoint_, from, paths_);
  require_same_physics(scene_, source, *checkpoint_, paths_);
  require_intact(paths_, *checkpoint_);
  complete_ = has_ended(scene_, *checkpoint_, paths_);
  n_changes_before_ = checkpoint_->changes.size();
  if (!complete_) checkpoint_ = continued(std::move(*checkpoint_), scene_, paths_);
}

std::vector<SceneChange> RunSession::changes() const {
  if (!checkpoint_) return {};
  return {checkpoint_->changes.begin() + static_cast<std::ptrdiff_t>(n_changes_before_), checkpoint_->changes.end()};
}

nlohmann::json RunSession::summarise(const RunOutcome& outcome) const {
  const HistoryTable history(paths_.history());
  const bool several = history_kind(scene_).rows == HistoryKind::of_all;
  const HistoryTable of_each = several ? HistoryTable(paths_.vesicles()) : history;
  const Checkpoint checkpoint = read_checkpoint(paths_.checkpoint());
  nlohmann::json summary = summary_of(history, of_each, scene_, checkpoint, outcome);
  summary["symmetry"] = imposed_symmetry(scene_, checkpoint.origin);
  if (scene_.numerics.error_bars) {
    summary["error_bars"] = worst_error(history, HistoryTable(paths_.history_error()));
  }
  return write_summary(paths_.summary(), std::move(summary));
}

nlohmann::json RunSession::last_summary() const {
  ReadingNotes notes;
  return read_summary(paths_.summary(), notes);
}

}  // namespace vehd
