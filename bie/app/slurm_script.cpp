#include "bie/app/slurm_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/app/scene_choice.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// A name that is allowed in quotes in a line #SBATCH, where % begins a pattern. @throws InputError
const std::string& sbatch_text(const std::string& name) {
  const bool is_refused = std::ranges::any_of(name, [](unsigned char letter) {
    return letter < 0x20 || letter == 0x7f || letter == '\'' || letter == '"' || letter == '\\' || letter == '%';
  });
  if (is_refused) {
    throw InputError(fmt::format(
        "--emit slurm: a line #SBATCH cannot hold {}; accepted: names without quotes, \\, % and control characters",
        shell_word(name)));
  }
  return name;
}

/// Optional lines #SBATCH.
std::string optional_lines(const SlurmTask& task) {
  std::string lines;
  if (task.memory_bytes > 0) {
    // Memory of the workers and of the process that starts them, plus one half.
    const double bytes = 1.5 * static_cast<double>(task.memory_bytes) * (task.n_jobs + 1);
    lines += fmt::format("#SBATCH --mem={:.0f}M\n", std::ceil(bytes / (1 << 20)));
  }
  if (!task.account.empty()) lines += fmt::format("#SBATCH --account=\"{}\"\n", sbatch_text(task.account));
  if (!task.partition.empty()) lines += fmt::format("#SBATCH --partition=\"{}\"\n", sbatch_text(task.partition));
  if (task.n_turns == 1) lines += "#SBATCH --requeue\n";
  return lines;
}

/// Shell command that submits all turns.
std::string submission(const SlurmTask& task) {
  const std::string script = shell_word(task.directory) + "/sweep.sbatch";
  if (task.n_turns == 1) return "sbatch " + script;
  return fmt::format(
      "job=$(sbatch --parsable {0}); for turn in {{2..{1}}}; do job=$(sbatch --parsable --dependency=afterany:$job "
      "{0}); done",
      script, task.n_turns);
}

constexpr const char* next_turn =
    R"(# Stopped at the end of the time, and its run can go on: once more, at the next turn.
if [ "$status" -eq 3 ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}"
fi
)";

}  // namespace

std::string slurm_script(const SlurmTask& task) {
  // Time for the current step; Slurm may send the signal up to a minute early.
  const int notice = std::clamp(task.minutes * 60 / 10, 10, 300);
  return fmt::format(
      R"(#!/bin/bash
# {predicted}
# {submission}
#SBATCH --job-name="{name}"
#SBATCH --array=0-{last}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={cpus}
#SBATCH --time={minutes}
#SBATCH --signal=TERM@{notice}
{optional_lines}#SBATCH --open-mode=append
#SBATCH --output="{directory}/slurm-%a.log"

{prologue}srun --cpus-per-task={cpus} {program} sweep {sweep} -o {directory_word} --member "$SLURM_ARRAY_TASK_ID/{members}" --jobs {jobs} --threads {threads}
status=$?
{next_turn}exit "$status"
)",
      fmt::arg("predicted", task.predicted), fmt::arg("submission", submission(task)),
      fmt::arg("optional_lines", optional_lines(task)), fmt::arg("prologue", task.prologue),
      fmt::arg("next_turn", task.n_turns == 1 ? next_turn : ""), fmt::arg("name", sbatch_text(task.name)),
      fmt::arg("last", task.n_members - 1), fmt::arg("members", task.n_members), fmt::arg("cpus", task.n_cpus),
      fmt::arg("minutes", task.minutes), fmt::arg("notice", notice), fmt::arg("directory", sbatch_text(task.directory)),
      fmt::arg("directory_word", shell_word(task.directory)), fmt::arg("program", shell_word(task.program)),
      fmt::arg("sweep", shell_word(task.sweep)), fmt::arg("jobs", task.n_jobs), fmt::arg("threads", task.n_threads));
}

}  // namespace vehd
