#include <boost/test/unit_test.hpp>

#include "tests/app/check_damages.hpp"

// The finite elements run one process on each processor.
BOOST_AUTO_TEST_SUITE(check_relaxing, *boost::unit_test::precondition(finite_elements_are_built) *
                                          boost::unit_test::label("slow") * boost::unit_test::label("once"))

namespace {

/// An immobile shape without symmetry; the charges on both faces are far from steady when the pulse ends.
const std::string scene_text =
    "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.15, 1.3]\nrotation = [0.3, 1.0, 0.2, 35.0]\n"
    "[membrane]\nmobile = false\ncapacitance = 1.0\nconductance = 0.5\n"
    "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\npermittivity = 0.3\n"
    "permittivity_ratio = 0.8\ndisplacement_current = true\n"
    "[electric.waveform]\nkind = 'pulse'\nduration = 0.6\n"
    "[numerics]\norder = 10\ntime_order = 2\ndt = 0.1\nend_time = 0.4\n[output]\nevery = 0.2\n";

std::vector<Damage> all_damages() {
  const double larger = 1.01;
  return {
      field_by("V_m", &CheckFields::potential_of_charges, "fields", "Vm_of_charges"),
      field_by("q", &CheckFields::charge, "fields", "q"),
      field_by("f_E", &CheckFields::force_electric, "fields", "force"),
      field_by("phi", &CheckFields::sample_potential, "fields", "potential_outside"),
      field_by("dq_i/dt", &CheckFields::potential_rate, "fields", "charging_current"),
      field_by("d(q_i+q_e)/dt", &CheckFields::free_charge_rate, "fields", "free_current"),
      {"stored V_m", [](CheckNumbers& n) { n.problem.frozen.fields.vesicles[0].potential *= 1.002; }, "stored",
       "Vm_of_charges"},
      {"stored q", [](CheckNumbers& n) { n.problem.frozen.fields.vesicles[0].charge *= 1.002; }, "stored", "q"},
      state_with(
          "epsilon_i", [=](FrozenState& s) { s.model.vesicles[0].inside.permittivity_ratio *= larger; }, "fields", "q"),
      state_with(
          "epsilon", [=](FrozenState& s) { s.model.electric->permittivity *= larger; }, "fields", "q"),
      state_with(
          "sigma_i", [=](FrozenState& s) { s.model.vesicles[0].inside.conductivity *= larger; }, "fields",
          "charging_current"),
      state_with(
          "sigma_e", [=](FrozenState& s) { s.model.electric->conductivity *= larger; }, "fields", "free_current"),
      state_with(
          "q_i", [=](FrozenState& s) { s.state.vesicles[0].transmembrane_potential *= larger; }, "fields", "q"),
      state_with(
          "q_e", [=](FrozenState& s) { s.state.vesicles[0].free_charge *= larger; }, "fields", "Vm_of_charges"),
  };
}

}  // namespace

BOOST_AUTO_TEST_CASE(charges_of_a_run_have_the_same_field_by_both_methods_and_damage_is_noticed) {
  const FinishedRun run(scene_text);
  check_and_damage(
      run, "0.4",
      {"q", "Vm_of_charges", "force", "Vm", "charging_current", "free_current", "potential_inside", "potential_near"},
      {"q", "Vm_of_charges", "force"}, all_damages());
}

BOOST_AUTO_TEST_CASE(charges_in_time_are_refused) {
  const FinishedRun run(scene_text);
  const std::string file = run.output + "/run.h5";
  const ProgramResult result = run_vehd({"check", file, "--from", "0.2", "--time", "0.4", "--quick"});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors ==
             file + ": has displacement currents; --from accepts runs without \"displacement_current\"\n");
}

BOOST_AUTO_TEST_SUITE_END()
