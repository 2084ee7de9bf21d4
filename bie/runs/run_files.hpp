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

/// All access to the files of a run. Each file is compared with its own checksums and with those that checkpoint.h5
/// beside it counts; while a run is in progress, its files may have more than that.
namespace vehd {

/// Files that were read without checksums because an earlier vehd wrote them: one line for each.
using ReadingNotes = std::vector<std::string>;

/// Reads a run.h5. @throws InputError naming the objects that are damaged, missing or of another run
RunReader read_snapshots(const std::filesystem::path& file, ReadingNotes& notes);

/// Reads a history.csv, vesicles.csv or history_error.csv. @throws InputError naming the damaged or missing row
HistoryTable read_table(const std::filesystem::path& file, ReadingNotes& notes);

/// Reads a summary.json; null if there is none, as during a run. @throws InputError if it was altered
nlohmann::json read_summary(const std::filesystem::path& file, ReadingNotes& notes);

/// Writes a summary.json with its checksum. @return its content @throws OutputError
nlohmann::json write_summary(const std::filesystem::path& file, nlohmann::json summary);

/// The scene of a run. @throws InputError
Scene read_scene_of(const RunReader& run);

/// The units of the files of a run: those that its history began with, in which pictures show its numbers. All are
/// dimensionless if there is no history. @throws InputError as read_table
/// @param scales  of the scene of the run
OutputUnits units_of_run(const RunPaths& paths, const std::optional<UnitsScene>& scales, ReadingNotes& notes);

/// Verifies everything that the checkpoint of a run counts, before the run resumes.
/// @throws InputError
void require_intact(const RunPaths& paths, const Checkpoint& checkpoint);

}  // namespace vehd
