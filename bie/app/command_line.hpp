#pragma once

#include "bie/support/ranks/ranks.hpp"

namespace vehd {

/// The whole program: parses, runs one command, reports errors on standard error.
/// @param ranks  ranks with which `vehd run` computes; all but the first are silent
/// @return       the exit code, an ExitCode; 0 on all ranks but the first
int run_program(int argc, char** argv, const Ranks& ranks = {});

}  // namespace vehd
