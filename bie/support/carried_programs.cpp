#include "bie/support/carried_programs.hpp"

#include <dlfcn.h>

#include <cstdlib>

namespace vehd {
namespace {

namespace fs = std::filesystem;

/// Python may have started this, so it is the library that says where it is.
fs::path folder_of_this_library() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&folder_of_this_library), &info) == 0) return {};
  std::error_code error;
  return fs::canonical(info.dli_fname, error).parent_path();
}

}  // namespace

fs::path place_of_program(const std::string& name) { return place_of_program(name, folder_of_this_library()); }

fs::path place_of_program(const std::string& name, const fs::path& libraries) {
  const fs::path programs = libraries / "programs";
  std::error_code error;
  if (libraries.empty() || !fs::is_directory(programs, error)) return name;
  const fs::path root = libraries.parent_path().parent_path();
  // Whoever has fonts of their own keeps them.
  ::setenv("FONTCONFIG_FILE", (root / "share/vehd/fonts.conf").c_str(), 0);
  if (fs::is_directory(root / "share/openmpi", error)) {
    // The libraries of the archive must not load plugins of another Open MPI, whatever a cluster sets.
    ::setenv("OPAL_PREFIX", root.c_str(), 1);
    ::setenv("PMIX_PREFIX", (root / "lib/x86_64-linux-gnu/pmix2").c_str(), 1);
  }
  return fs::exists(programs / name, error) ? programs / name : fs::path(name);
}

}  // namespace vehd
