#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/finite_elements.hpp"
#include "tests/app/program.hpp"

// Cases in which fields vanish or are not determined: spheres, on which a uniform tension has no effect, and vesicles
// that are images of one another.
BOOST_AUTO_TEST_SUITE(check_spheres, *boost::unit_test::precondition(finite_elements_are_built) *
                                         boost::unit_test::label("slow") * boost::unit_test::label("extended") *
                                         boost::unit_test::label("once"))

namespace {

/// Result of a quick check, which must end with a table.
nlohmann::json checked(const std::string& file, const std::string& directory) {
  const ProgramResult result =
      run_vehd({"check", file, "--quick", "--ranks", "1", "-o", directory, "--no-plot", "--json", directory + ".json"});
  BOOST_TEST_REQUIRE((result.exit_code == 0 || result.exit_code == 4), file + ": " + result.errors);
  BOOST_TEST_MESSAGE(result.output);
  return json_of(directory + ".json");
}

/// Requires that no row of one vesicle disagrees.
void require_no_disagreement(const nlohmann::json& vesicle, const std::string& where) {
  for (const char* group : {"fields", "from_shape", "stored"}) {
    for (const auto& [row, values] : vesicle[group].items()) {
      BOOST_TEST(values["verdict"].get<std::string>() != "disagree", where + " " + row + ": " + values.dump());
    }
  }
}

const std::string sphere =
    "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.0, 1.0]\n[membrane]\nbending_modulus = 0.1\nconductance = 1.0\n"
    "[numerics]\norder = 8\ndt = 0.1\nend_time = 0.0\n";
const std::string shear = "[flow]\nkind = 'shear'\nrate = 1.0\n", contrast = "[fluid]\nviscosity_ratio = 3.0\n";
const std::string field =
    "[electric]\nfield = [0.3, 0.0, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\ninitial_Vm = 'steady'\n";

}  // namespace

// Regression, a crash: the common type of two matrices in a conditional had three rows, but a tension has one.
BOOST_AUTO_TEST_CASE(one_sphere_is_checked_in_every_flow) {
  const std::string extension = "[flow]\nkind = 'axisymmetric_extension'\nrate = 1.0\n";
  for (const std::string& further : {shear, contrast + shear, extension, field, shear + field}) {
    const TemporaryDirectory directory;
    write_text(directory / "scene.toml", sphere + further);
    const nlohmann::json json = checked(directory / "scene.toml", directory / "out");
    require_no_disagreement(json, further);
    BOOST_TEST(json["from_shape"].contains("tension"), further);
  }
}

BOOST_AUTO_TEST_CASE(two_spheres_are_checked_whether_they_are_equal_or_not) {
  const std::string left = "[[vesicle]]\nname = 'left'\nshape.centre = [-1.5, 0.0, 0.0]\n",
                    equal = "[[vesicle]]\nname = 'right'\nshape.centre = [1.5, 0.0, 0.0]\n",
                    smaller = equal + "shape.axes = [0.7, 0.7, 0.7]\n";
  for (const std::string& further : {shear + left + equal, contrast + shear + left + equal, shear + left + smaller}) {
    const TemporaryDirectory directory;
    write_text(directory / "scene.toml", sphere + further);
    const nlohmann::json json = checked(directory / "scene.toml", directory / "out");
    BOOST_TEST_REQUIRE(json["vesicles"].size() == 2U);
    for (const nlohmann::json& vesicle : json["vesicles"]) require_no_disagreement(vesicle, further);
  }
}

// Regression, "density has 625 entries but 0 are expected": an image has no operators of its own.
BOOST_AUTO_TEST_CASE(two_prolates_are_checked_at_their_start_and_after_a_step) {
  const TemporaryDirectory directory;
  const std::string scene = VEHD_SOURCE_DIR "/docs/scenes/two_prolates.toml";
  const nlohmann::json of_scene = checked(scene, directory / "of_scene");
  const ProgramResult run = run_vehd({"run", scene, "-o", directory / "run", "--no-plot", "--set", "numerics.degree=12",
                                      "--set", "numerics.end_time=0.2", "--set", "output.every=0.2"});
  BOOST_TEST_REQUIRE(run.exit_code == 0, run.errors);
  const nlohmann::json of_run = checked(directory / "run", directory / "of_run");
  for (const nlohmann::json& json : {of_scene, of_run}) {
    BOOST_TEST_REQUIRE(json["vesicles"].size() == 2U);
    for (const nlohmann::json& vesicle : json["vesicles"]) {
      BOOST_TEST(vesicle["fields"]["velocity"]["verdict"].get<std::string>() != "disagree");
      BOOST_TEST(vesicle["fields"]["q"]["verdict"].get<std::string>() == "agree", vesicle["fields"]["q"].dump());
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
