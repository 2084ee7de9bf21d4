#include "tests/app/check_damages.hpp"

// The finite elements run one process on each processor.
BOOST_AUTO_TEST_SUITE(check_undulations, *boost::unit_test::precondition(finite_elements_are_built) *
                                             boost::unit_test::label("slow") * boost::unit_test::label("once"))

namespace {

const std::string scene_text =
    "[shape]\nkind = 'ellipsoid'\naxes = [1.3, 1.1, 0.9]\nrotation = [0.3, 1.0, 0.2, 35.0]\n"
    "[membrane]\nbending_modulus = 0.1\nundulations = true\ntemperature = 0.02\nstretching_modulus = 20.0\n"
    "reference_tension = 0.5\n"
    "[flow]\nkind = 'shear'\nrate = 1.0\n"
    "[numerics]\norder = 10\ntime_order = 2\ndt = 0.1\nend_time = 0.2\n[output]\nevery = 0.2\n";

// r ∝ 1 + s P₂ with s = 0.1, which relaxes under σ = 200 κ_c/a².
const std::string relaxing_scene =
    "[shape]\nkind = 'radial'\nmodes = [{n = 2, m = 0, a = 0.15853309}]\n"
    "[membrane]\nbending_modulus = 2.0\nundulations = true\ntemperature = 0.0411\nstretching_modulus = 2.4e8\n"
    "reference_tension = 200.0\n"
    "[numerics]\ndegree = 16\ndt = 1e-5\nend_time = 0.0\n";

}  // namespace

// The elements take the dilation from the boundary integrals and must find the mean tension.
BOOST_AUTO_TEST_CASE(tension_and_dilation_are_those_of_the_elements_and_damage_is_noticed) {
  const FinishedRun run(scene_text);
  check_and_damage(run, "0.2", {"velocity"}, {"force_tension_work", "tension", "velocity", "surface_divergence"},
                   {state_with(
                        "mean tension", [](FrozenState& s) { s.model.vesicles[0].undulations->rest_area *= 0.999; },
                        "from_shape", "tension"),
                    {"stored tension", [](CheckNumbers& n) { n.problem.frozen.fields.vesicles[0].tension *= 1.02; },
                     "stored", "tension"}});
}

BOOST_AUTO_TEST_CASE(relaxing_shape_has_the_velocity_and_tension_of_the_elements) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", relaxing_scene);
  const ProgramResult check = run_vehd({"check", directory / "scene.toml", "--quick", "--ranks", "1", "--no-plot", "-o",
                                        directory / "out", "--json", directory / "result.json"});
  BOOST_TEST(check.exit_code == 0, check.output + check.errors);
  const nlohmann::json rows = json_of(directory / "result.json")["from_shape"];
  for (const char* row : {"velocity", "tension"}) {
    BOOST_TEST(rows[row]["verdict"] == "agree", row);
    BOOST_TEST(rows[row]["l2"].get<double>() < 1e-6, row << ": " << rows[row]);
  }
}

BOOST_AUTO_TEST_SUITE_END()
