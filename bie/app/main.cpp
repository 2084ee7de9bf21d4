#include "bie/app/command_line.hpp"

int main(int argc, char** argv) { return vehd::run_program(argc, argv); }
