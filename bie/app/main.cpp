#include <unistd.h>

#include <cstdlib>

#include "bie/app/command_line.hpp"

int main(int argc, char** argv) {
  // OpenMP reads its environment once, when the program is loaded. Threads that spin while they wait lose whole time
  // slices as soon as anything else runs on the machine: ten times slower on two cores that are not idle.
  if (std::getenv("OMP_WAIT_POLICY") == nullptr) {
    setenv("OMP_WAIT_POLICY", "passive", 1);
    execv("/proc/self/exe", argv);
  }
  return vehd::run_program(argc, argv);
}
