#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string_view>

#include "bie/app/command_line.hpp"
#ifdef VEHD_MPI
#include "bie/mpi/mpi_ranks.hpp"
#include "bie/support/exit_code.hpp"
#endif

int main(int argc, char** argv) {
  // OpenMP reads its environment once, when the program is loaded. Threads that spin while they wait lose whole time
  // slices as soon as anything else runs on the machine: ten times slower on two cores that are not idle.
  if (std::getenv("OMP_WAIT_POLICY") == nullptr) {
    setenv("OMP_WAIT_POLICY", "passive", 1);
    execv("/proc/self/exe", argv);
  }
  // A write beyond the limit of file sizes (ulimit -f) then fails as on a full disk, and the run stops normally.
  std::signal(SIGXFSZ, SIG_IGN);
#ifdef VEHD_MPI
  if (const int tasks = vehd::separate_tasks(); tasks > 1 && argc > 1 && std::string_view(argv[1]) == "run") {
    fmt::print(stderr,
               "srun has started {} tasks without MPI, and each would compute the whole run: use srun --mpi=pmix, or "
               "the name in srun --mpi=list for another MPI\n",
               tasks);
    return static_cast<int>(vehd::ExitCode::wrong_input);
  }
  return vehd::run_program(argc, argv, vehd::mpi_ranks());
#else
  return vehd::run_program(argc, argv);
#endif
}
