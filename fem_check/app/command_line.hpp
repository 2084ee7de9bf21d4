#pragma once

namespace vehd::fem_check {

/// The program vehd_fem, the finite-element side of `vehd check`, `vehd mesh` and `vehd bench methods`, which start it.
/// Takes the arguments of main(), prints the results and writes the files.
/// @return exit code: 0 (done, whatever the verdict), 1 (wrong input) or 2 (internal error)
int run_program(int argc, char** argv);

}  // namespace vehd::fem_check
