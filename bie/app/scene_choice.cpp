#include "bie/app/scene_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "bie/scene/given_time.hpp"
#include "bie/scene/nearest_name.hpp"
#include "bie/scene/units.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd {
std::string shell_word(const std::string& word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string text = "'";
  for (const char letter : word) {
    if (letter == '\'') {
      text += "'\\''";
    } else {
      text += letter;
    }
  }
  return text + "'";
}

std::string text_of(const SceneSource& scene) {
  std::string text = shell_word(scene.file.string());
  for (const std::string& setting : scene.settings) text += fmt::format(" --set {}", shell_word(setting));
  return text;
}

void add_scene_choice(CLI::App& command, SceneSource& scene) {
  command.add_option("SCENE", scene.file, "Scene file (TOML)")->required();
  add_settings(command, scene);
}

void add_settings(CLI::App& command, SceneSource& scene) {
  command
      .add_option("--set", scene.settings,
                  "Another value for a key of the scene, as in --set flow.rate=2.5; any number of times")
      ->type_name("TABLE.KEY=VALUE")
      ->allow_extra_args(false);
}

void add_frozen_state(CLI::App& command, std::filesystem::path& file) {
  const auto file_of_run = [](std::string text) {
    std::error_code ignored;
    return std::filesystem::is_directory(text, ignored) ? (std::filesystem::path(text) / "run.h5").string() : text;
  };
  command.add_option("FILE", file, "Directory of a run, its run.h5, or a scene (.toml) for its initial state")
      ->required()
      ->transform(file_of_run);
}

int WorkerOptions::jobs() const { return n_jobs > 0 ? n_jobs : std::max(1, omp_get_num_procs() / n_threads); }

void add_workers(CLI::App& command, WorkerOptions& workers) {
  command
      .add_option(
          "--jobs", workers.n_jobs,
          "Workers on this machine, each of which computes one run at a time; if not given, all processors are used")
      ->type_name("N")
      ->check(CLI::Range(1, most_threads));
  command.add_option("--threads", workers.n_threads, "Number of threads of each worker; one if not given")
      ->type_name("N")
      ->check(CLI::Range(1, most_threads));
}

void add_threads_option(CLI::App& command) {
  command
      .add_option_function<int>(
          "--threads", [](int count) { omp_set_num_threads(count); },
          "Number of threads; "
          "OMP_NUM_THREADS, or all that the machine has, if not given")
      ->check(CLI::Range(1, most_threads));
}

CLI::Validator time_text() {
  return CLI::Validator([](const std::string& text) { return problem_of_time(text); }, "");
}

void add_snapshot_time(CLI::App& command, std::optional<std::string>& time) {
  command
      .add_option("--time", time,
                  "Time as \"0.5 ms\", or a number in the unit of history.csv; the nearest snapshot is taken, the last "
                  "one if left out")
      ->type_name("T")
      ->check(time_text());
}

std::filesystem::path default_directory(const std::filesystem::path& scene_file) {
  return std::filesystem::path("out") / scene_file.stem();
}

CLI::Validator number_in(double least, double most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    const auto given = parse_quantity(text);
    if (given && given->unit.empty() && least <= given->number && given->number <= most) return "";
    return fmt::format("is {}; accepted: a number from {:g} to {:g}", text, least, most);
  };
  return CLI::Validator(check, fmt::format("FLOAT in [{:g} - {:g}]", least, most));
}

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string list = fmt::format("{{{}}}", fmt::join(words, ","));
  const auto check = [words = std::move(words)](const std::string& word) -> std::string {
    if (std::find(words.begin(), words.end(), word) != words.end()) return "";
    return fmt::format("\"{}\" is unknown; {}", word,
                       suggestion(word, std::vector<std::string_view>(words.begin(), words.end())));
  };
  return CLI::Validator(check, list);
}

}  // namespace vehd
