#include "bie/runs/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bie/files/json_text.hpp"
#include "bie/runs/snapshot_store.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/checksum.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

/// Key of the checksum in summary.json.
constexpr const char* summary_checksum = "checksum";

void note_unsealed(const std::filesystem::path& file, ReadingNotes& notes) {
  const std::string note =
      fmt::format("{}: an earlier vehd wrote it without checksums: damage to it would not be noticed", file.string());
  if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
}

/// The checkpoint in the folder of a file of a run; nullopt if there is none, or if an earlier vehd wrote it and its
/// counts have another meaning.
std::optional<Checkpoint> checkpoint_beside(const std::filesystem::path& file, ReadingNotes& notes) {
  const std::filesystem::path checkpoint = RunPaths{file.parent_path()}.checkpoint();
  if (!std::filesystem::exists(checkpoint)) return std::nullopt;
  try {
    return read_checkpoint(checkpoint);
  } catch (const OtherSchemaVersion&) {
    note_unsealed(checkpoint, notes);
    return std::nullopt;
  }
}

/// Size and checksum of a table according to a checkpoint.
struct CountedTable {
  std::int64_t bytes = 0, checksum = 0;
};

CountedTable counted_table(const Checkpoint& checkpoint, const std::filesystem::path& file) {
  const RunPaths paths{file.parent_path()};
  if (file == paths.history()) return {checkpoint.history_bytes, checkpoint.history_checksum};
  if (file == paths.vesicles()) return {checkpoint.vesicles_bytes, checkpoint.vesicles_checksum};
  if (file == paths.history_error() && checkpoint.companion) {
    return {checkpoint.companion->bytes, checkpoint.companion->checksum};
  }
  return {};
}

std::int64_t checksum_of(nlohmann::json summary) {
  summary.erase(summary_checksum);
  Checksum checksum;
  checksum.add(json_text(summary));
  return checksum.value();
}

}  // namespace

RunReader read_snapshots(const std::filesystem::path& file, ReadingNotes& notes) {
  // Read before the file: whatever is written meanwhile is beyond its counts.
  const std::optional<Checkpoint> checkpoint = checkpoint_beside(file, notes);
  RunReader run(file);
  if (!run.is_sealed()) {
    note_unsealed(file, notes);
  } else if (checkpoint && file == RunPaths{file.parent_path()}.snapshots()) {
    require_counted(run, checkpoint->n_snapshots, checkpoint->snapshots_checksum);
  }
  return run;
}

HistoryTable read_table(const std::filesystem::path& file, ReadingNotes& notes) {
  const std::optional<Checkpoint> checkpoint = checkpoint_beside(file, notes);
  HistoryTable table(file);
  if (!table.is_sealed()) note_unsealed(file, notes);
  if (checkpoint) {
    const CountedTable counted = counted_table(*checkpoint, file);
    require_history(file, counted.bytes, counted.checksum);
  }
  return table;
}

nlohmann::json read_summary(const std::filesystem::path& file, ReadingNotes& notes) {
  if (!std::filesystem::exists(file)) return nullptr;
  const nlohmann::json summary = nlohmann::json::parse(text_of_file(file), nullptr, false);
  if (!summary.is_object())
    throw InputError(fmt::format("{}: is not a JSON object: damaged or altered", file.string()));
  const auto checksum = summary.find(summary_checksum);
  if (checksum == summary.end()) {
    note_unsealed(file, notes);
  } else if (*checksum != checksum_of(summary)) {
    throw InputError(fmt::format("{}: was altered: it does not match its checksum", file.string()));
  }
  return summary;
}

nlohmann::json write_summary(const std::filesystem::path& file, nlohmann::json summary) {
  summary[summary_checksum] = checksum_of(summary);
  replace_file(file, json_text(summary));
  return summary;
}

Scene read_scene_of(const RunReader& run) {
  return parse_scene(run.scene(), run.name() + " (scene)", std::filesystem::path(run.name()).parent_path());
}

OutputUnits units_of_run(const RunPaths& paths, const std::optional<UnitsScene>& scales, ReadingNotes& notes) {
  const bool is_counted = std::filesystem::exists(paths.checkpoint());
  if (!is_counted && !std::filesystem::exists(paths.history())) return {};
  auto symbols = read_table(paths.history(), notes).symbols();
  // With several vesicles, vesicles.csv has dimensions that history.csv lacks.
  if (std::filesystem::exists(paths.vesicles())) symbols.merge(read_table(paths.vesicles(), notes).symbols());
  return {scales, std::move(symbols)};
}

void require_intact(const RunPaths& paths, const Checkpoint& checkpoint) {
  if (checkpoint.n_snapshots > 0) {
    const RunReader run(paths.snapshots());
    require_counted(run, checkpoint.n_snapshots, checkpoint.snapshots_checksum);
    for (std::int64_t i = 0; i < checkpoint.n_snapshots; ++i) (void)run.snapshot(static_cast<std::size_t>(i));
  }
  for (const auto& file : {paths.history(), paths.vesicles(), paths.history_error()}) {
    const CountedTable counted = counted_table(checkpoint, file);
    require_history(file, counted.bytes, counted.checksum);
  }
}

}  // namespace vehd
