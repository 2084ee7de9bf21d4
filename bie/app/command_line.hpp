#pragma once

namespace vehd {

/// The whole program: parses, runs one command, reports errors on standard error.
/// @return the exit code, an ExitCode
int run_program(int argc, char** argv);

}  // namespace vehd
