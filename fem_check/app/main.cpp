#include "fem_check/app/command_line.hpp"

int main(int argc, char** argv) { return vehd::fem_check::run_program(argc, argv); }
