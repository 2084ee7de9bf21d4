#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bie/files/run_reader.hpp"
#include "bie/runs/checkpoint.hpp"
#include "bie/runs/history.hpp"
#include "bie/runs/run_directory.hpp"

/// The only way to the files of a run. Each is compared with the checksums within it, and with those that checkpoint.h5
/// beside it counts; a run that is still under way may have more than that. Whatever reads a run reads it here.
namespace vehd {

/// Files that were read without checksums, since an earlier vehd wrote them: one line for each.
using ReadingNotes = std::vector<std::string>;

/// A run.h5. @throws InputError naming the objects that are damaged, missing or of another run
RunReader read_snapshots(const std::filesystem::path& file, ReadingNotes& notes);

/// A history.csv, vesicles.csv or history_error.csv. @throws InputError naming the row that is damaged or missing
HistoryTable read_table(const std::filesystem::path& file, ReadingNotes& notes);

/// A summary.json; null where there is none, as while a run is under way. @throws InputError if it was altered
nlohmann::json read_summary(const std::filesystem::path& file, ReadingNotes& notes);

/// Writes a summary.json with its checksum. @return its content @throws OutputError
nlohmann::json write_summary(const std::filesystem::path& file, nlohmann::json summary);

/// The scene of a run. @throws InputError
Scene read_scene_of(const RunReader& run);

/// The units of the files of a run, which are those that its history began with: pictures show its numbers in these.
/// All dimensionless where there is no history. @throws InputError as read_table
/// @param scales  of the scene of the run
OutputUnits units_of_run(const RunPaths& paths, const std::optional<UnitsScene>& scales, ReadingNotes& notes);

/// Compares everything that the checkpoint of a run counts, before the run goes on.
/// @throws InputError
void require_intact(const RunPaths& paths, const Checkpoint& checkpoint);

}  // namespace vehd
