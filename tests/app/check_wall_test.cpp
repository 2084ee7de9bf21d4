#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/check_damages.hpp"
#include "tests/app/finite_elements.hpp"

// The finite elements run one process on each processor.
BOOST_AUTO_TEST_SUITE(check_wall, *boost::unit_test::precondition(finite_elements_are_built) *
                                      boost::unit_test::label("slow") * boost::unit_test::label("once") *
                                      boost::unit_test::label("extended"))

namespace {

const std::string vesicle_text =
    "[shape]\nkind = 'radial'\nbase = 1.0\namplitude = 0.1\n"
    "modes = [{n = 2, m = 0, a = 1.0}, {n = 3, m = 1, a = 0.5}, {n = 3, m = -2, a = -0.4}]\n"
    "centre = [0.3, -0.2, 1.6]\n"
    "[membrane]\nbending_modulus = 0.1\nspontaneous_curvature = 0.5\nconductance = 0.5\n";
const std::string numerics_text = "[numerics]\norder = 10\ndt = 0.02\nend_time = 0.0\n";

std::string heavy_text(const std::string& viscosity_ratio) {
  return "[fluid]\nviscosity_ratio = " + viscosity_ratio +
         "\ndensity_difference = 0.3\n[gravity]\nacceleration = [0.2, 0.1, -1.0]\n";
}

std::string electric_text(const std::string& field) {
  return "[electric]\nfield = " + field +
         "\nconductivity_in = 2.0\nconductivity_out = 1.0\npermittivity_ratio = 0.5\ninitial_Vm = 'steady'\n";
}

/// Requires that every row of a check agrees. @param what  arguments that select the scene or the run
void require_agreement_of(const std::vector<std::string>& what) {
  const TemporaryDirectory directory;
  std::vector<std::string> command{"check",     "-o",     directory / "check",      "--quick",
                                   "--no-plot", "--json", directory / "result.json"};
  command.insert(command.end(), what.begin(), what.end());
  const ProgramResult checked = run_vehd(command);
  BOOST_TEST_REQUIRE(checked.exit_code == 0, checked.output + checked.errors);
  nlohmann::json result = json_of(directory / "result.json");
  for (const char* group : {"fields", "from_shape", "stored", "in_time"}) {
    for (const auto& [row, values] : result[group].items()) {
      if (values.is_object()) BOOST_TEST(values["verdict"] == "agree", group << ": " << row);
    }
  }
}

void require_agreement(const std::string& scene) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", scene);
  require_agreement_of({directory / "scene.toml"});
}

/// A run from 0 to 0.6 beside an electrode, to which a mobile vesicle sinks.
std::string charging_text(bool mobile) {
  return std::string("[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.15, 1.3]\nrotation = [0.3, 1.0, 0.2, 35.0]\n") +
         "centre = [0.0, 0.0, 1.5]\n[membrane]\ncapacitance = 1.0\nconductance = 0.5\n" +
         (mobile ? "bending_modulus = 0.1\n[fluid]\ndensity_difference = 1.0\n[gravity]\n"
                   "acceleration = [0.0, 0.0, -1.0]\n[wall]\nflow = 'no-slip'\n"
                 : "mobile = false\n[wall]\n") +
         "normal = [0.0, 0.0, 1.0]\nfield = 'electrode'\n"
         "[electric]\nfield = [0.0, 0.0, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
         "[numerics]\norder = 8\ntime_order = 3\ndt = 0.1\nend_time = 0.6\n[output]\nevery = 0.1\n";
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_row_agrees_above_a_coverslip_in_shear) {
  require_agreement(vesicle_text + heavy_text("3.0") +
                    "[wall]\nnormal = [0.0, 0.0, 1.0]\nflow = 'no-slip'\nfield = 'insulating'\n" +
                    "[flow]\nkind = 'shear'\nrate = 0.8\n" + electric_text("[0.3, 0.5, 0.0]") + numerics_text);
}

BOOST_AUTO_TEST_CASE(every_row_agrees_below_a_free_surface_and_beside_an_electrode_at_any_angle) {
  require_agreement(vesicle_text + heavy_text("0.3") +
                    "[wall]\npoint = [0.0, 0.0, -0.2]\nnormal = [0.3, -0.2, 1.0]\nflow = 'stress-free'\n"
                    "field = 'electrode'\n" +
                    electric_text("[0.3, -0.2, 1.0]") + numerics_text);
}

BOOST_AUTO_TEST_CASE(potential_in_time_agrees_beside_an_electrode_at_rest_and_sinking_to_it) {
  for (const bool mobile : {false, true}) {
    const FinishedRun run(charging_text(mobile));
    require_agreement_of({run.output + "/run.h5", "--from", "0.2", "--time", "0.6"});
  }
}

BOOST_AUTO_TEST_CASE(wall_elsewhere_or_of_the_other_kind_is_noticed) {
  const FinishedRun run(vesicle_text +
                        "[wall]\nnormal = [0.0, 0.0, 1.0]\nflow = 'stress-free'\nfield = 'insulating'\n" +
                        electric_text("[0.3, 0.5, 0.0]") + numerics_text);
  check_and_damage(run, "0", {"q"}, {"q", "velocity"},
                   {state_with(
                        "wall further away", [](FrozenState& s) { s.model.wall->point.z() -= 0.2; }, "fields", "q"),
                    state_with(
                        "wall without slip", [](FrozenState& s) { s.model.wall->flow = vehd::WallFlow::no_slip; },
                        "fields", "velocity")});
}

BOOST_AUTO_TEST_CASE(walls_that_the_elements_do_not_support_are_refused) {
  const TemporaryDirectory directory;
  const auto refused = [&](const std::string& scene, const std::string& message) {
    write_text(directory / "scene.toml", scene);
    const ProgramResult result = run_vehd({"check", directory / "scene.toml", "--quick"});
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(result.errors.find(message) != std::string::npos, result.errors);
  };
  refused(vesicle_text + "[wall]\nnormal = [0.0, 0.0, 1.0]\nfield = 'insulating'\n" + electric_text("[0.3, 0.5, 0.0]") +
              numerics_text,
          "has a wall without effect on the flow; vehd check accepts \"flow\" no-slip or stress-free in [wall]");
  refused(vesicle_text + "[wall]\nnormal = [0.0, 0.0, 1.0]\nflow = 'no-slip'\n" + electric_text("[0.3, 0.5, 0.0]") +
              numerics_text,
          "has a wall without effect on the field; vehd check accepts \"field\" insulating or electrode in [wall]");
}

BOOST_AUTO_TEST_SUITE_END()
