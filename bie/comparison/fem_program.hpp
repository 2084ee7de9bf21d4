#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bie/support/exit_code.hpp"

namespace vehd {

/// Whether the finite-element program is beside the running program.
bool fem_program_is_built();

/// The separate executable of the finite-element side. deal.II brings the OpenMPI build of HDF5, which must not meet
/// the serial one in one process.
class FemProgram {
 public:
  /// Looks beside the running program.
  /// @throws InputError saying how to build it if it is not there
  FemProgram();
  /// Looks in a folder.
  /// @throws InputError likewise
  explicit FemProgram(const std::filesystem::path& folder);

  /// Files that it writes.
  struct Result {
    ExitCode code = ExitCode::done;
    nlohmann::json json;  ///< its result; null if it ended before it had one
  };

  /// Runs it with these arguments on the terminal of this program, and waits. It ends with this program.
  /// @param n_ranks  processes, started by mpirun if more than one
  /// @throws InputError if it cannot be started, std::runtime_error if a signal ended it
  [[nodiscard]] Result run(std::vector<std::string> arguments, int n_ranks = 1) const;

 private:
  std::filesystem::path path_;
};

}  // namespace vehd
