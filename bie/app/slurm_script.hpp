#pragma once

#include <cstdint>
#include <string>

namespace vehd {

/// Options of an array of Slurm jobs.
struct SlurmTask {
  std::string name;     ///< name of the job
  std::string program;  ///< path of this program
  std::string sweep;    ///< path of the sweep file
  std::string directory;
  std::size_t n_members = 1;
  int n_cpus = 1;  ///< processors of each member, for the threads of all its workers
  int n_jobs = 1;  ///< workers of each member
  int n_threads = 1;
  int minutes = 60;                ///< time limit of one turn of a member
  int n_turns = 1;                 ///< number of arrays, one after the other; 1: a member requeues itself
  std::int64_t memory_bytes = 0;   ///< memory of a worker; 0 if unknown
  std::string account, partition;  ///< names on the cluster; empty: its defaults
  std::string prologue;            ///< shell lines before the work, such as module load
  std::string predicted;           ///< line about the predicted cost
};

/// Text of a script for sbatch: an array of jobs, each a worker of the sweep. A member is stopped before its time is
/// over; its run resumes at the next turn of the member.
/// @throws InputError if a name is not allowed in a Slurm script
std::string slurm_script(const SlurmTask& task);

}  // namespace vehd
