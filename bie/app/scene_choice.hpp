#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "bie/scene/settings.hpp"

/// Options that several commands share.
namespace vehd {

/// A text quoted as one word of a shell.
std::string shell_word(const std::string& word);

/// The part of a command line that names this scene, quoted for a shell.
std::string text_of(const SceneSource& scene);

/// Adds SCENE and --set.
void add_scene_choice(CLI::App& command, SceneSource& scene);
/// Adds --set only.
void add_settings(CLI::App& command, SceneSource& scene);

/// Adds FILE, whose fields or shape are examined: a scene, a run.h5, or the directory of a run in place of its run.h5.
void add_frozen_state(CLI::App& command, std::filesystem::path& file);

/// Processes that compute runs side by side.
struct WorkerOptions {
  int n_jobs = 0;  ///< 0: not given
  int n_threads = 1;

  /// Number of processes; as many as there are processors for, if not given.
  [[nodiscard]] int jobs() const;
};
/// Adds --jobs, and --threads of each worker.
void add_workers(CLI::App& command, WorkerOptions& workers);

/// Adds --threads, which takes effect at once.
void add_threads_option(CLI::App& command);

/// Accepts a time: a number, or one with a unit of time.
CLI::Validator time_text();
/// Adds --time, the time of a snapshot of a run.
void add_snapshot_time(CLI::App& command, std::optional<std::string>& time);

/// Default directory for the results of a scene: out/NAME of NAME.toml.
std::filesystem::path default_directory(const std::filesystem::path& scene_file);

/// Accepts finite numbers of a range; CLI::Range accepts nan.
CLI::Validator number_in(double least, double most);

/// Accepts only these words. An error names the nearest one; help and completion list all.
CLI::Validator one_of(std::vector<std::string> words);

}  // namespace vehd
