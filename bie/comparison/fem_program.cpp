#include "bie/comparison/fem_program.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <utility>

#include "bie/support/child_process.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

constexpr const char* fem_name = "vehd_fem";

std::filesystem::path folder_of_this_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

bool is_program(const std::filesystem::path& path) { return ::access(path.c_str(), X_OK) == 0; }

/// Sets options of mpirun by environment variables: its command-line options differ between Open MPI 4 and 5, and each
/// version ignores the variables of the other.
/// @param folder  for its temporary files
void prepare_mpirun(const std::filesystem::path& folder) {
  // Processes of version 4 share a folder otherwise, which one that ends may remove just when another has made it.
  ::setenv("OMPI_MCA_orte_tmpdir_base", folder.c_str(), 1);
  for (const auto& [name, value] : std::initializer_list<std::pair<const char*, const char*>>{
           // Containers often have only the user root, and fewer slots than ranks.
           {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
           {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
           {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
           {"PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe"},
           // Ranks that spin while they wait slow down working ranks if anything else runs on the machine.
           {"OMPI_MCA_mpi_yield_when_idle", "1"},
           // When mpirun is stopped it ends its processes at once.
           {"OMPI_MCA_odls_base_sigkill_timeout", "0"},
           {"PRTE_MCA_odls_base_sigkill_timeout", "0"},
           // All processes are on this machine. Without a network, version 5 complains about TCP, which is not needed.
           {"OMPI_MCA_btl", "^tcp"},
           // Suppresses messages of mpirun itself; version 5 has no such variable.
           {"OMPI_MCA_orte_execute_quiet", "1"},
       }) {
    ::setenv(name, value, 0);
  }
}

}  // namespace

bool fem_program_is_built() { return is_program(folder_of_this_program() / fem_name); }

FemProgram::FemProgram() : FemProgram(folder_of_this_program()) {}

FemProgram::FemProgram(const std::filesystem::path& folder) : path_(folder / fem_name) {
  if (is_program(path_)) return;
  throw InputError(fmt::format(
      "{}: the finite-element program is not there; a build is configured with VEHD_FEM_CHECK=ON "
      "(cmake -DSTEP=check -P bie/setup.cmake), and of archives the one without \"plain\" in its name has it",
      path_.string()));
}

FemProgram::Result FemProgram::run(std::vector<std::string> arguments, int n_ranks) const {
  const TemporaryFolder folder("vehd-result");
  const std::filesystem::path json = folder.path() / "result.json";
  arguments.insert(arguments.end(), {"--json", json.string()});
  std::vector<std::string> words;
  if (n_ranks > 1) {
    prepare_mpirun(folder.path());
    words = {"mpirun", "-n", std::to_string(n_ranks)};
  }
  words.push_back(path_.string());
  words.insert(words.end(), arguments.begin(), arguments.end());
  // Leaves free memory to the finite elements.
  malloc_trim(0);
  const ChildEnd end = run_child({words, {}});
  if (end.start_problem != 0) {
    throw InputError(fmt::format("{} cannot be started: {}", words[0], std::strerror(end.start_problem)));
  }
  if (end.signal != 0) throw std::runtime_error(fmt::format("{} was ended by signal {}", words[0], end.signal));
  FemProgram::Result result{static_cast<ExitCode>(end.exit_code), {}};
  if (std::filesystem::exists(json)) result.json = nlohmann::json::parse(text_of_file(json));
  const bool holds = !result.json.contains("verdict") || result.json["verdict"] == "agree";
  if (result.code == ExitCode::done && !holds) result.code = ExitCode::check_failed;
  return result;
}

}  // namespace vehd
