#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/finite_elements.hpp"
#include "tests/app/program.hpp"

BOOST_AUTO_TEST_SUITE(check_shapes, *boost::unit_test::precondition(finite_elements_are_built) *
                                        boost::unit_test::label("slow") * boost::unit_test::label("once"))

namespace {

/// Result of a quick check of a scene on one rank.
nlohmann::json checked(const std::string& scene, const std::vector<std::string>& further) {
  const TemporaryDirectory directory;
  std::vector<std::string> command{
      "check", VEHD_SOURCE_DIR "/" + scene, "--quick",   "--ranks", "1",
      "-o",    directory / "out",           "--no-plot", "--json",  directory / "result.json"};
  command.insert(command.end(), further.begin(), further.end());
  const ProgramResult result = run_vehd(command);
  BOOST_TEST((result.exit_code == 0 || result.exit_code == 4), result.errors);
  BOOST_TEST_MESSAGE(result.output);
  return json_of(directory / "result.json");
}

void require_agreement(const nlohmann::json& json) {
  for (const char* group : {"fields", "from_shape", "stored"}) {
    for (const auto& [row, values] : json[group].items()) {
      BOOST_TEST(values["verdict"].get<std::string>() == "agree", group << " " << row << " " << values.dump());
    }
  }
}

}  // namespace

// Contrasts, spontaneous curvature, weight, an oblique field, and a flow and a shape without symmetry.
BOOST_AUTO_TEST_CASE(every_row_agrees_where_all_effects_act) {
  const nlohmann::json json = checked("docs/checks/everything.toml", {});
  require_agreement(json);
  for (const char* row : {"bending", "spontaneous_curvature", "bending_work", "tension", "velocity"}) {
    BOOST_TEST(json["from_shape"].contains(row), row);
  }
  BOOST_TEST(json["from_shape"]["velocity"]["l2"].get<double>() < 1e-3);
}

// Two bulbs joined by a neck, at a lower degree than on the page.
BOOST_AUTO_TEST_CASE(every_row_of_the_dumbbell_agrees) {
  const nlohmann::json json = checked("docs/checks/dumbbell.toml", {"--set", "numerics.degree=24"});
  require_agreement(json);
  BOOST_TEST(json["from_shape"]["bending_work"]["l2"].get<double>() < 1e-3);
  BOOST_TEST(json["from_shape"]["velocity"]["l2"].get<double>() < 1e-2);
}

// The flow due to the change of f_E is solved with fewer digits than that of all forces. Its error is included: it was
// the larger of the two if f_E is large.
BOOST_AUTO_TEST_CASE(velocity_of_own_electric_force_agrees_where_that_force_is_large) {
  const nlohmann::json json = checked("tests/hard/scenes/electric_capillary_1e4.toml", {});
  const nlohmann::json& row = json["fields"]["velocity_own_force"];
  BOOST_TEST(row["verdict"].get<std::string>() == "agree", row.dump());
}

BOOST_AUTO_TEST_SUITE_END()
