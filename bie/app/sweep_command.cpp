#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <numeric>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/app/slurm_script.hpp"
#include "bie/estimate/sweep_cost.hpp"
#include "bie/runs/sweep/sweep_work.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/progress.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd {
namespace {

namespace fs = std::filesystem;

struct SweepOptions {
  fs::path file;
  std::string directory;
  WorkerOptions workers;
  std::array<std::size_t, 2> member{0, 1};
  std::string emit;
  int minutes = 60;
  int n_turns = 1;
  std::string account, partition, prologue;
  bool quiet = false;
  CommonOptions common;

  [[nodiscard]] SweepPaths paths() const { return {directory.empty() ? default_directory(file) : fs::path(directory)}; }
};

/// A sweep and its runs, read and checked before any run begins.
struct PreparedSweep {
  SweepFile sweep;
  std::vector<SweepRun> runs;
  SweepPaths paths;
};

PreparedSweep prepared(const SweepOptions& options) {
  SweepFile sweep = read_sweep(options.file);
  // Reports unknown columns before anything is computed.
  static_cast<void>(columns_of(sweep));
  const SweepPaths paths = options.paths();
  if (fs::exists(RunPaths{paths.directory}.history())) {
    throw InputError(fmt::format("{}: already holds a run (history.csv); choose another -o", paths.directory.string()));
  }
  make_directory(paths.runs());
  std::vector<SweepRun> runs = runs_of(sweep);
  return {std::move(sweep), std::move(runs), paths};
}

/// The run with which member K of N of an array of jobs begins, so that the members meet as late as possible.
std::size_t first_of(const std::array<std::size_t, 2>& member, std::size_t n_runs) {
  const auto [k, n] = member;
  if (k >= n) throw InputError(fmt::format("--member {}/{}: accepted: K/N with K from 0 to N - 1", k, n));
  return k * n_runs / n;
}

nlohmann::json json_of(const SweepCount& count, const PreparedSweep& sweep) {
  return {{"runs", sweep.runs.size()}, {"completed", count.completed},
          {"stopped", count.stopped},  {"refused", count.refused},
          {"crashed", count.crashed},  {"unfinished", count.unfinished},
          {"seconds", count.seconds},  {"table", sweep.paths.table().string()}};
}

void print_count(const SweepCount& count, const PreparedSweep& sweep) {
  std::string text = fmt::format("{} runs: {} completed", sweep.runs.size(), count.completed);
  const auto add = [&](std::int64_t number, const char* what) {
    if (number > 0) text += fmt::format(", {} {}", number, what);
  };
  add(count.stopped, "stopped");
  add(count.refused, "refused");
  add(count.crashed, "crashed");
  add(count.unfinished, "unfinished");
  fmt::print("{}; total computing time {}\ntable: {}\n", text, duration_text(count.seconds),
             sweep.paths.table().string());
}

ExitCode emit_slurm(const SweepOptions& options, const PreparedSweep& sweep) {
  const SweepCost cost = predicted_cost(sweep.runs);
  const std::vector<double>& seconds = cost.seconds;
  const int n_jobs = options.workers.n_jobs > 0 ? options.workers.n_jobs : 1;
  const double total = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  const double longest = seconds.empty() ? 0.0 : *std::ranges::max_element(seconds);
  SlurmTask task;
  task.name = options.file.stem().string();
  task.program = fs::read_symlink("/proc/self/exe").string();
  task.sweep = fs::absolute(options.file).lexically_normal().string();
  task.directory = fs::absolute(sweep.paths.directory).lexically_normal().string();
  // With a margin for low predictions; more members than runs would have nothing to do.
  constexpr double margin = 1.5;
  const double wanted = std::ceil(margin * total / (60.0 * options.minutes * n_jobs));
  const auto most = static_cast<double>(std::max<std::size_t>(sweep.runs.size(), 1));
  task.n_members = static_cast<std::size_t>(std::clamp(wanted, 1.0, most));
  task.n_jobs = n_jobs;
  task.n_threads = options.workers.n_threads;
  task.n_cpus = n_jobs * options.workers.n_threads;
  task.minutes = options.minutes;
  task.n_turns = options.n_turns;
  task.memory_bytes = cost.memory_bytes;
  task.account = options.account;
  task.partition = options.partition;
  if (!options.prologue.empty()) task.prologue = text_of_file(options.prologue) + "\n";
  task.predicted = fmt::format("{} runs; predicted computing time {} in total, {} for the longest", sweep.runs.size(),
                               duration_text(total), duration_text(longest));
  replace_shared_file(sweep.paths.slurm_script(), slurm_script(task));
  fmt::print("{}\n{} jobs of {} min\nscript: {}\n", task.predicted, task.n_members, options.minutes,
             sweep.paths.slurm_script().string());
  write_json(options.common,
             {{"script", sweep.paths.slurm_script().string()}, {"jobs", task.n_members}, {"seconds", total}});
  return ExitCode::done;
}

ExitCode sweep(const SweepOptions& options) {
  // One thread until the workers are started: they are copies of this process, without its other threads.
  const ThreadCount one(1);
  const PreparedSweep sweep = prepared(options);
  if (!options.emit.empty()) return emit_slurm(options, sweep);
  const std::size_t first = first_of(options.member, sweep.runs.size());
  std::string problem;
  {
    Interruption interruption;
    Progress progress(options.quiet ? Progress::Style::none : Progress::suitable_style());
    const auto start = std::chrono::steady_clock::now();
    const auto show = [&](std::int64_t n_finished, std::int64_t n_runs, double share) {
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      const std::string left = share > 0.0 ? duration_text(seconds.count() * (1.0 / share - 1.0)) : "?";
      progress.update(share, fmt::format("{}/{} runs  left {}", n_finished, n_runs, left));
    };
    const int n_workers = std::clamp<int>(static_cast<int>(sweep.runs.size()), 1, options.workers.jobs());
    problem = run_sweep({sweep.paths, sweep.runs, n_workers, options.workers.n_threads, show, first}, interruption);
    progress.finish();
  }
  const SweepCount count = write_sweep_table(sweep.paths, sweep.sweep, sweep.runs);
  print_count(count, sweep);
  write_json(options.common, json_of(count, sweep));
  if (!problem.empty()) {
    fmt::print(stderr, "{}; the same command continues from here\n", problem);
    return ExitCode::stopped_early;
  }
  if (count.unfinished > 0) {
    fmt::print(stderr,
               "unfinished runs belong to other workers; the same command resumes those whose workers have ended\n");
  }
  return ExitCode::done;
}

}  // namespace

void add_sweep_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("sweep", "Simulate a scene for many values of its keys");
  const auto options = std::make_shared<SweepOptions>();
  command->add_option("SWEEP", options->file, "Sweep file (TOML): scene, [vary], mode, columns")->required();
  command
      ->add_option("-o,--output", options->directory,
                   "Directory for the table and the runs, created if missing; out/NAME of NAME.toml if not given")
      ->type_name("DIR");
  add_workers(*command, options->workers);
  CLI::Option* emit =
      command->add_option("--emit", options->emit, "Only write DIR/sweep.sbatch, an array of jobs for Slurm")
          ->check(one_of({"slurm"}));
  command
      ->add_option("--minutes", options->minutes,
                   "With --emit: time limit of each job; a job with unfinished runs is queued again")
      ->type_name("N")
      ->check(CLI::Range(1, 60 * 24 * 30))
      ->capture_default_str()
      ->needs(emit);
  command->add_option("--account", options->account, "With --emit: account that pays for the jobs")
      ->type_name("NAME")
      ->needs(emit);
  command->add_option("--partition", options->partition, "With --emit: partition of the cluster")
      ->type_name("NAME")
      ->needs(emit);
  command
      ->add_option("--prologue", options->prologue,
                   "With --emit: lines of shell before the work of each job, such as module load; lines that begin "
                   "with #SBATCH come first")
      ->type_name("FILE")
      ->check(CLI::ExistingFile)
      ->needs(emit);
  command
      ->add_option("--turns", options->n_turns,
                   "With --emit: N arrays, each after the one before (by dependencies), for clusters where no job may "
                   "queue itself again")
      ->type_name("N")
      ->check(CLI::Range(2, 1000))
      ->needs(emit);
  command
      ->add_option("--member", options->member, "Member K, from 0, of an array of N jobs; each begins with another run")
      ->delimiter('/')
      ->type_name("K/N");
  command->add_flag("--quiet", options->quiet, "Show no progress");
  add_common_options(*command, options->common);
  command->footer(
      "Writes table.csv, one row for each run, sweep.json, and the runs themselves below runs/.\n"
      "The same command may run at the same time on this machine and on others that share the files. After a\n"
      "Ctrl-C, a crash or a change of SWEEP it computes the runs that are missing. Pictures: vehd plot DIR.\n"
      "See docs/sweeps.md.");
  command->callback([options, &exit_code] { exit_code = sweep(*options); });
}

}  // namespace vehd
