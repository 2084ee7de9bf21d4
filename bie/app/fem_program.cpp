#include "bie/app/fem_program.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "bie/support/errors.hpp"

namespace vehd {
namespace {

std::filesystem::path program_beside_this_one() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::filesystem::path("vehd_fem") : self.parent_path() / "vehd_fem";
}

}  // namespace

bool fem_program_is_built() { return ::access(program_beside_this_one().c_str(), X_OK) == 0; }

FemProgram::FemProgram() : path_(program_beside_this_one()) {
  if (fem_program_is_built()) return;
  throw InputError(
      fmt::format("{}: the finite-element program is not built; configure with VEHD_FEM_CHECK=ON "
                  "(cmake -DSTEP=check -P bie/setup.cmake)",
                  path_.string()));
}

ExitCode FemProgram::run(const std::vector<std::string>& arguments, int n_ranks) const {
  std::vector<std::string> words;
  if (n_ranks > 1) {
    // Containers have root alone, and often fewer slots than Open MPI wants to see.
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
    words = {"mpirun", "-q", "--oversubscribe", "-n", std::to_string(n_ranks)};
  }
  words.push_back(path_.string());
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  // What this program has printed so far comes first.
  std::fflush(stdout);
  pid_t process = 0;
  const int problem = posix_spawnp(&process, pointers[0], nullptr, nullptr, pointers.data(), environ);
  if (problem != 0) throw InputError(fmt::format("{} cannot be started: {}", words[0], std::strerror(problem)));
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status)) {
    throw std::runtime_error(fmt::format("{} was ended by signal {}", words[0], WTERMSIG(status)));
  }
  return static_cast<ExitCode>(WEXITSTATUS(status));
}

}  // namespace vehd
