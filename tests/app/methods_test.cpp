#include <boost/test/unit_test.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/app/finite_elements.hpp"
#include "tests/app/program.hpp"

namespace {

namespace fs = std::filesystem;

/// Levels of one method, coarse to fine.
std::vector<nlohmann::json> levels_of(const nlohmann::json& bench, const std::string& method,
                                      const std::string& table = "rows") {
  std::vector<nlohmann::json> levels;
  for (const auto& level : bench[table]) {
    if (level["method"] == method) levels.push_back(level);
  }
  return levels;
}

double error(const nlohmann::json& level, const std::string& field) { return level["error_" + field]; }

/// Power of the number of unknowns with which an error decreases.
double power(const std::vector<nlohmann::json>& levels, const std::string& field) {
  return std::log(error(levels.front(), field) / error(levels.back(), field)) /
         std::log(levels.back()["unknowns"].get<double>() / levels.front()["unknowns"].get<double>());
}

}  // namespace

BOOST_AUTO_TEST_SUITE(methods, *boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(both_methods_approach_the_exact_solution_each_at_its_rate,
                     *boost::unit_test::precondition(finite_elements_are_built)) {
  const TemporaryDirectory directory;
  const ProgramResult run =
      run_vehd({"bench", "methods", "--quick", "-o", directory / "out", "--json", directory / "copy.json"});
  BOOST_REQUIRE_MESSAGE(run.exit_code == 0, run.errors);
  const auto bench = json_of(directory / "out/methods.json");
  BOOST_TEST((bench == json_of(directory / "copy.json")));

  const auto bie = levels_of(bench, "bie");
  const auto by_degree = levels_of(bench, "fem_degree"), by_mesh = levels_of(bench, "fem_mesh");
  for (const auto& levels : {bie, by_degree, by_mesh}) BOOST_REQUIRE(levels.size() == 2);
  BOOST_TEST(error(bie.back(), "q") < 1.2e-3);
  BOOST_TEST(error(bie.back(), "force") < 5e-3);
  BOOST_TEST(error(by_degree.back(), "q") < 5e-3);
  BOOST_TEST(error(by_degree.back(), "force") < 3e-2);
  // Degree k = 2 in three dimensions: the error of q decreases with about the power k/3 of the unknowns.
  BOOST_TEST(power(by_mesh, "q") > 0.6);
  BOOST_TEST(power(by_mesh, "q") < 1.2);
  BOOST_TEST(power(bie, "q") > 2.0);
  // Each level of finite elements is a separate process, so equal levels have equal errors.
  BOOST_TEST(error(by_degree.front(), "q") == error(by_mesh.front(), "q"));
  // The truncation at the outer sphere does not limit the errors of the table.
  BOOST_TEST(bench["truncation_change_q"].get<double>() < 5e-2 * error(by_degree.back(), "q"));
  for (const auto& level : bench["rows"]) {
    BOOST_TEST(level["memory_bytes"].get<double>() > 1e6);
    BOOST_TEST(level["seconds_min"].get<double>() <= level["seconds_max"].get<double>());
  }
  BOOST_TEST(bench["machine"].contains("compiler"));
  for (const char* picture : {"out/methods.png", "out/methods_from_shape.png"}) {
    BOOST_TEST(fs::file_size(directory / picture) > 10000u, picture);
  }
  const std::string csv = file_text(directory / "out/methods.csv");
  BOOST_TEST(std::count(csv.begin(), csv.end(), '\n') == 7);
  for (const char* input : {"out/sources.h5", "out/shape_flow.h5"}) BOOST_TEST(!fs::exists(directory / input), input);

  // The unknowns of a step, computed from the shape.
  const auto flow_bie = levels_of(bench, "bie", "from_shape"), flow_fem = levels_of(bench, "fem_degree", "from_shape");
  for (const auto& levels : {flow_bie, flow_fem}) {
    BOOST_REQUIRE(levels.size() == 2);
    for (const char* field : {"velocity", "tension"}) {
      BOOST_TEST(error(levels.back(), field) < 0.8 * error(levels.front(), field), field);
      BOOST_TEST(error(levels.back(), field) < 0.3, field << " " << error(levels.back(), field));
    }
  }
}

BOOST_AUTO_TEST_CASE(unusable_directory_is_an_input_error, *boost::unit_test::precondition(finite_elements_are_built)) {
  const TemporaryDirectory directory;
  write_text(directory / "file", "");
  const ProgramResult run = run_vehd({"bench", "methods", "--quick", "-o", directory / "file"});
  BOOST_TEST(run.exit_code == 1);
  BOOST_TEST(run.errors.find("cannot be used as output directory") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
