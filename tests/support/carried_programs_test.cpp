#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "bie/support/child_process.hpp"
#include "tests/support/files.hpp"

namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Unsets the variables of an archive before and after a case.
struct NoVariables {
  NoVariables() { unset(); }
  ~NoVariables() { unset(); }
  NoVariables(const NoVariables&) = delete;
  NoVariables& operator=(const NoVariables&) = delete;
  static void unset() {
    for (const char* name : {"FONTCONFIG_FILE", "OPAL_PREFIX", "PMIX_PREFIX"}) ::unsetenv(name);
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(carried_programs)

BOOST_FIXTURE_TEST_CASE(without_an_archive_names_stay_names, NoVariables) {
  const TemporaryDirectory root;
  BOOST_TEST(vehd::program_path("gnuplot") == "gnuplot");
  BOOST_TEST(vehd::program_path("gnuplot", root / "lib/vehd") == "gnuplot");
  BOOST_TEST(variable("FONTCONFIG_FILE").empty());
}

BOOST_FIXTURE_TEST_CASE(an_archive_starts_its_own_programs_with_its_own_files, NoVariables) {
  const TemporaryDirectory root;
  const std::string libraries = root / "lib/vehd";
  std::filesystem::create_directories(libraries + "/programs");
  write_text(libraries + "/programs/gnuplot", "");
  BOOST_TEST(vehd::program_path("gnuplot", libraries) == libraries + "/programs/gnuplot");
  BOOST_TEST(vehd::program_path("ffmpeg", libraries) == "ffmpeg");
  BOOST_TEST(variable("FONTCONFIG_FILE") == root / "share/vehd/fonts.conf");
  BOOST_TEST(variable("OPAL_PREFIX").empty());

  std::filesystem::create_directories(root / "share/openmpi");
  ::setenv("FONTCONFIG_FILE", "mine", 1);
  ::setenv("OPAL_PREFIX", "of a cluster", 1);
  BOOST_TEST(vehd::program_path("mpirun", libraries) == "mpirun");
  BOOST_TEST(variable("FONTCONFIG_FILE") == "mine");
  BOOST_TEST(variable("OPAL_PREFIX") + "/" == root / "");
}

BOOST_AUTO_TEST_SUITE_END()
