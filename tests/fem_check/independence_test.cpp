#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

constexpr std::array modules = {"support",  "sphere",     "linear", "kernels", "geometry", "potentials",
                                "physics",  "stepping",   "files",  "scene",   "runs",     "estimate",
                                "pictures", "comparison", "bench",  "fit",     "app"};

bool names_library(const std::string& line, const std::string& library) {
  const auto begin = line.find(library);
  if (begin == std::string::npos) return false;
  const char next = begin + library.size() < line.size() ? line[begin + library.size()] : ' ';
  return std::isalnum(static_cast<unsigned char>(next)) == 0 && next != '_';
}

/// Agreement of two methods is evidence only if they share no numerics.
void shares_nothing(const std::filesystem::path& path) {
  const bool is_build_file = path.filename() == "CMakeLists.txt";
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const bool shared =
        is_build_file ? std::ranges::any_of(
                            modules, [&](const std::string& module) { return names_library(line, "vehd_" + module); })
                      : line.find("#include") == 0 && line.find("bie/") != std::string::npos;
    BOOST_TEST(!shared, path.string() + ": " + line);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(independence)

BOOST_AUTO_TEST_CASE(nothing_of_the_boundary_integral_solver_is_included_or_linked) {
  const std::filesystem::path source = VEHD_SOURCE_DIR;
  int n_files = 0;
  for (const char* folder : {"meshes", "fem_check"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / folder)) {
      if (!entry.is_regular_file()) continue;
      shares_nothing(entry.path());
      ++n_files;
    }
  }
  BOOST_TEST(n_files > 50);
}

BOOST_AUTO_TEST_SUITE_END()
