#include "bie/files/versions.hpp"

#include <fftw3.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <string_view>

#include "bie/files/hdf5_handle.hpp"
#include "bie/linear/instruction_set.hpp"
#include "commit.hpp"

namespace vehd {
namespace {

std::string compiler() {
#ifdef __clang__
  const std::string name = __VERSION__;
#else
  const std::string name = "g++ " __VERSION__;
#endif
  // Among several instruction sets, the one that the loader chose.
  const std::string built_for = VEHD_ARCHITECTURE;
  const std::string architecture = built_for == "levels" ? instruction_set() : built_for;
  return architecture.empty() ? name : name + " -march=" + architecture;
}

}  // namespace

std::string program_version() { return VEHD_VERSION; }

std::string program_commit() { return VEHD_COMMIT; }

std::map<std::string, std::string> library_versions() {
  silence_hdf5();
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return {{"compiler", compiler()},
          {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"fftw", std::string(std::string_view(fftw_version).substr(std::string_view("fftw-").size()))},
          {"hdf5", fmt::format("{}.{}.{}", major, minor, release)}};
}

}  // namespace vehd
