#pragma once

namespace vehd::fem_check {

/// The program vehd_fem, the finite-element side of `vehd check`, `vehd mesh` and `vehd bench methods`, which start it.
/// Takes what main() is given, prints and writes what they ask for.
/// @return exit code, 0, 1 (wrong input), 2 (internal error) or 4 (the methods do not agree)
int run_program(int argc, char** argv);

}  // namespace vehd::fem_check
