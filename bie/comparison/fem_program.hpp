#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bie/support/exit_code.hpp"

namespace vehd {

/// Whether the finite-element program is in the folder of the running program.
bool fem_program_is_built();

/// The separate executable of the finite-element side. deal.II uses the OpenMPI build of HDF5, which must not be in one
/// process with the serial one.
class FemProgram {
 public:
  /// Looks in the folder of the running program.
  /// @throws InputError saying how to build it if it is not there
  FemProgram();
  /// Looks in a folder.
  /// @throws InputError saying how to build it if it is not there
  explicit FemProgram(const std::filesystem::path& folder);

  /// Result of one call.
  struct Result {
    ExitCode code = ExitCode::done;
    nlohmann::json json;  ///< its result; null if it ended before writing one
  };

  /// Runs it with these arguments on the terminal of this program, and waits. It is ended if this program ends.
  /// @param n_ranks  processes, started by mpirun if more than one
  /// @throws InputError if it cannot be started, std::runtime_error if a signal ended it
  [[nodiscard]] Result run(std::vector<std::string> arguments, int n_ranks = 1) const;

 private:
  std::filesystem::path path_;
};

}  // namespace vehd
