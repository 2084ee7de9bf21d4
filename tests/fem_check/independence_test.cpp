#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

namespace {

/// Agreement of two methods is evidence only if they share no numerics.
void shares_nothing(const std::filesystem::path& path) {
  static const std::regex include("#include +[\"<](\\.\\./)*bie/.*");
  static const std::regex solver_library(
      ".*\\bvehd_(support|sphere|linear|kernels|geometry|potentials|physics|stepping|files|scene|runs)\\b.*|"
      ".*\\bvehd_(estimate|pictures|comparison|bench|app)\\b.*");
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const bool shared =
        path.filename() == "CMakeLists.txt" ? std::regex_match(line, solver_library) : std::regex_search(line, include);
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
