#include "tests/app/check_damages.hpp"

// The finite elements run one process on each processor.
BOOST_AUTO_TEST_SUITE(check_conducting, *boost::unit_test::precondition(finite_elements_are_built) *
                                            boost::unit_test::label("slow") * boost::unit_test::label("once"))

namespace {

/// An immobile shape without symmetry, with opening pores and with spatially varying capacitance and pump current.
const std::string scene_text =
    "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.15, 1.3]\nrotation = [0.3, 1.0, 0.2, 35.0]\n"
    "[membrane]\nmobile = false\ncapacitance = 0.5\nconductance = 0.3\n"
    "[membrane.varying_capacitance]\nkind = 'harmonics'\nmodes = [{n = 1, m = 1, a = 0.3}]\n"
    "[membrane.pump]\ncurrent = 0.4\nkind = 'harmonics'\nmodes = [{n = 1, m = -1, a = 1.0}, {n = 2, m = 0, a = 0.5}]\n"
    "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\npermittivity = 0.3\n"
    "[poration]\nmodel = 'pores'\ncreation_rate = 1.0\ncreation_Vm = 0.5\nrest_density = 2.0\npore_radius = 0.1\n"
    "membrane_thickness = 0.2\n"
    "[numerics]\norder = 10\ntime_order = 2\ndt = 0.1\nend_time = 0.4\n[output]\nevery = 0.2\n";

std::vector<Damage> all_damages() {
  const double larger = 1.02;
  return {
      field_by("C dV_m/dt", &CheckFields::potential_rate, "fields", "charging_current"),
      {"stored G_m", [=](CheckNumbers& n) { n.problem.frozen.fields.vesicles[0].conductance *= larger; }, "fields",
       "charging_current"},
      state_with(
          "s", [=](FrozenState& s) { s.state.vesicles[0].poration *= larger; }, "fields", "charging_current"),
      state_with(
          "J_p", [=](FrozenState& s) { s.state.vesicles[0].material.pump_current *= larger; }, "fields",
          "charging_current"),
  };
}

}  // namespace

BOOST_AUTO_TEST_CASE(both_methods_agree_on_the_current_through_a_porated_membrane_and_notice_damage) {
  const FinishedRun run(scene_text);
  check_and_damage(run, "0.4", {"q", "force", "charging_current", "potential_inside", "potential_near"}, {"q", "force"},
                   all_damages());
}

BOOST_AUTO_TEST_CASE(its_way_in_time_is_refused) {
  const FinishedRun run(scene_text);
  const std::string file = run.output + "/run.h5";
  const ProgramResult result = run_vehd({"check", file, "--from", "0.2", "--time", "0.4", "--quick"});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors.starts_with(file + ": has a membrane that porates or varies in space; "), result.errors);
}

BOOST_AUTO_TEST_SUITE_END()
