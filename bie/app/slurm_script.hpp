#pragma once

#include <cstdint>
#include <string>

namespace vehd {

/// Options of an array of Slurm jobs.
struct SlurmTask {
  std::string name;     ///< of the job
  std::string program;  ///< this one
  std::string sweep;    ///< file
  std::string directory;
  std::size_t n_members = 1;
  int n_cpus = 1;  ///< of each member: as many workers, or threads of workers
  int n_jobs = 1;  ///< workers of each member
  int n_threads = 1;
  int minutes = 60;                ///< that a member may take at once
  int n_turns = 1;                 ///< arrays one after the other; 1: a member asks for another turn itself
  std::int64_t memory_bytes = 0;   ///< that a worker needs; 0 where that is unknown
  std::string account, partition;  ///< of the cluster; empty: its usual ones
  std::string prologue;            ///< lines before the work, such as of modules
  std::string predicted;           ///< a line about the cost
};

/// Text of a script for sbatch: an array of jobs, each a worker of the sweep. Before the time is over a member is told
/// to end; its run goes on when the member has its next turn.
/// @throws InputError if Slurm cannot be given one of the names
std::string slurm_script(const SlurmTask& task);

}  // namespace vehd
