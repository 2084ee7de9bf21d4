#pragma once

namespace vehd {

/// The whole program: parses, runs one command, reports errors on standard error.
/// @return the exit code of design: 0 done, 1 wrong input or usage, 2 internal error, 3 stopped early and resumable
int run_program(int argc, char** argv);

}  // namespace vehd
