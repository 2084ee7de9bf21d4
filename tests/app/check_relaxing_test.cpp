#include <boost/test/unit_test.hpp>
#include <functional>
#include <nlohmann/json.hpp>

#include "bie/comparison/check_input.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/reference_run.hpp"

// The finite elements are one process for each processor.
BOOST_AUTO_TEST_SUITE(check_relaxing, *boost::unit_test::precondition(finite_elements_are_built) *
                                          boost::unit_test::label("slow") * boost::unit_test::label("once"))

namespace {

using vehd::CheckFields;
using vehd::FrozenState;

/// A shape without symmetry that stands still; the charges of both faces are far from steady when the pulse ends.
const std::string scene_text =
    "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.15, 1.3]\nrotation = [0.3, 1.0, 0.2, 35.0]\n"
    "[membrane]\nmobile = false\ncapacitance = 1.0\nconductance = 0.5\n"
    "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\npermittivity = 0.3\n"
    "permittivity_ratio = 0.8\ndisplacement_current = true\n"
    "[electric.waveform]\nkind = 'pulse'\nduration = 0.6\n"
    "[numerics]\norder = 10\ntime_order = 2\ndt = 0.1\nend_time = 0.4\n[output]\nevery = 0.2\n";

/// What the boundary-integral side hands over.
struct Numbers {
  FrozenState frozen;
  vehd::CheckContents contents;
  vehd::CheckSamples samples;
  CheckFields bie, high;

  void solve(const FrozenState& state) {
    bie = vehd::check_fields(state, contents, {}, 10, samples.points);
    high = vehd::check_fields(state, contents, {}, 15, samples.points);
  }
};

struct Damage {
  std::string name;
  std::function<void(Numbers&)> apply;
  std::string group, row;  ///< one that has to see it
};

template <typename Values>
Damage field_by(const std::string& name, Values CheckFields::*field, const std::string& group, const std::string& row) {
  constexpr double factor = 1.002;
  return {name,
          [=](Numbers& numbers) {
            for (CheckFields* fields : {&numbers.bie, &numbers.high}) fields->*field *= factor;
          },
          group, row};
}

/// One side of the comparison has another coefficient, or exchanges the sides.
Damage state_with(const std::string& name, const std::function<void(FrozenState&)>& change, const std::string& group,
                  const std::string& row) {
  return {name,
          [=](Numbers& numbers) {
            FrozenState wrong = numbers.frozen;
            change(wrong);
            numbers.solve(wrong);
          },
          group, row};
}

std::vector<Damage> all_damages() {
  const double larger = 1.01;
  return {
      field_by("V_m", &CheckFields::potential_of_charges, "fields", "Vm_of_charges"),
      field_by("q", &CheckFields::charge, "fields", "q"),
      field_by("f_E", &CheckFields::force_electric, "fields", "force"),
      field_by("phi", &CheckFields::sample_potential, "fields", "potential_outside"),
      field_by("dq_i/dt", &CheckFields::potential_rate, "stored", "charging_current"),
      field_by("d(q_i+q_e)/dt", &CheckFields::free_charge_rate, "stored", "free_current"),
      {"stored V_m", [](Numbers& n) { n.frozen.fields.vesicles[0].potential *= 1.002; }, "stored", "Vm_of_charges"},
      {"stored q", [](Numbers& n) { n.frozen.fields.vesicles[0].charge *= 1.002; }, "stored", "q"},
      state_with(
          "epsilon_i", [=](FrozenState& s) { s.model.vesicles[0].inside.permittivity_ratio *= larger; }, "fields", "q"),
      state_with(
          "epsilon", [=](FrozenState& s) { s.model.electric->permittivity *= larger; }, "fields", "q"),
      state_with(
          "sigma_i", [=](FrozenState& s) { s.model.vesicles[0].inside.conductivity *= larger; }, "stored",
          "charging_current"),
      state_with(
          "sigma_e", [=](FrozenState& s) { s.model.electric->conductivity *= larger; }, "stored", "free_current"),
      state_with(
          "q_i", [=](FrozenState& s) { s.state.vesicles[0].transmembrane_potential *= larger; }, "fields", "q"),
      state_with(
          "q_e", [=](FrozenState& s) { s.state.vesicles[0].free_charge *= larger; }, "fields", "Vm_of_charges"),
  };
}

}  // namespace

BOOST_AUTO_TEST_CASE(charges_of_a_run_have_the_same_field_by_both_methods_and_damage_is_noticed) {
  const FinishedRun run(scene_text);
  const std::string file = run.output + "/run.h5";
  Numbers right;
  right.frozen = vehd::read_frozen_state({file, {}}, "0.4");
  right.contents = vehd::check_contents(right.frozen);
  right.samples = vehd::check_samples(right.frozen.state.vesicles.front().position);
  right.solve(right.frozen);
  const auto written = [&](const std::string& name, const Numbers& n) {
    vehd::write_check_input(run.directory / name, {n.frozen, n.contents, {}, n.samples, n.bie, n.high});
    return run.directory / name;
  };
  std::vector<std::string> command{
      finite_element_program().string(), "check",  written("right.h5", right),   "--quick", "-o",
      run.directory / "elements",        "--json", run.directory / "result.json"};
  const std::vector<Damage> damages = all_damages();
  for (std::size_t i = 0; i < damages.size(); ++i) {
    Numbers wrong = right;
    damages[i].apply(wrong);
    command.insert(command.end(), {"--further", written("wrong" + std::to_string(i) + ".h5", wrong)});
  }
  const ProgramResult program = run_command(command);
  BOOST_TEST(program.exit_code == 0, program.output + program.errors);
  const nlohmann::json json = json_of(run.directory / "result.json");
  for (const char* row : {"q", "Vm_of_charges", "force", "Vm", "potential_inside", "potential_near"}) {
    BOOST_TEST(json["fields"][row]["verdict"] == "agree", row);
  }
  for (const char* row : {"q", "Vm_of_charges", "force", "charging_current", "free_current"}) {
    BOOST_TEST(json["stored"][row]["verdict"] == "agree", row);
  }
  BOOST_TEST_REQUIRE(json["further"].size() == damages.size());
  for (std::size_t i = 0; i < damages.size(); ++i) {
    const Damage& damage = damages[i];
    BOOST_TEST(json["further"][i][damage.group][damage.row]["verdict"] == "does not",
               damage.name << " in " << damage.row << ": " << json["further"][i][damage.group][damage.row]);
  }
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
