#include <boost/test/unit_test.hpp>
#include <functional>
#include <nlohmann/json.hpp>

#include "bie/comparison/check.hpp"
#include "bie/comparison/check_input.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/reference_run.hpp"

BOOST_AUTO_TEST_SUITE(check_in_time, *boost::unit_test::precondition(finite_elements_are_built) *
                                         boost::unit_test::label("slow") * boost::unit_test::label("extended") *
                                         boost::unit_test::label("once"))

namespace {

using vehd::FrozenState;
using vehd::InTime;

const std::filesystem::path fem_folder = std::filesystem::path(VEHD_PROGRAM).parent_path();

/// An immobile shape without symmetry that is charging; the field jumps within the run.
const std::string charging_scene =
    "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.15, 1.3]\nrotation = [0.3, 1.0, 0.2, 35.0]\n"
    "[membrane]\nmobile = false\ncapacitance = 1.0\nconductance = 0.5\n"
    "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\npermittivity = 1.0\n"
    "[electric.waveform]\nkind = 'pulse'\nduration = 0.6\n"
    "[numerics]\norder = 8\ntime_order = 3\ndt = 0.1\nend_time = 1.0\n[output]\nevery = 0.2\n";

/// Data of one time span that the boundary-integral side passes to the finite elements.
struct Numbers {
  FrozenState end;
  InTime in_time;

  void advance(const FrozenState& state) {
    in_time.at_order = vehd::potential_in_time(state, in_time.span, 8, false);
    in_time.for_error = vehd::potential_in_time(state, in_time.span, 12, true);
  }
};

Numbers numbers_of(const std::string& file) {
  Numbers numbers;
  numbers.end = vehd::read_frozen_state({file, {}}, "1.0");
  numbers.in_time.span = vehd::read_time_span(file, "0.4", numbers.end);
  numbers.advance(numbers.end);
  return numbers;
}

void write_numbers_of(const std::string& path, const Numbers& numbers) {
  vehd::CheckProblem problem = vehd::check_problem(numbers.end);
  problem.samples = {};
  vehd::write_check_input(
      path, {problem, vehd::check_fields(problem, {8}), vehd::check_fields(problem, {12}), &numbers.in_time});
}

}  // namespace

BOOST_AUTO_TEST_CASE(potential_of_a_run_is_advanced_and_a_percent_is_noticed) {
  const FinishedRun run(charging_scene);
  const std::string file = run.output + "/run.h5";
  const Numbers right = numbers_of(file);
  BOOST_TEST(right.in_time.span.positions.size() == 1U);
  BOOST_TEST(right.in_time.span.field_times.size() == 2U * (vehd::span_intervals + 1));
  // The steps of the run, repeated from the snapshot on, end at the V_m of the run.
  const vehd::Vector& stored = right.end.state.vesicles.front().transmembrane_potential;
  BOOST_TEST((right.in_time.at_order - stored).norm() < 1e-3 * stored.norm());

  std::vector<std::function<void(Numbers&)>> damages;
  for (const double factor : {1.01, -1.0, 0.5}) {
    damages.emplace_back([=](Numbers& n) { n.end.state.vesicles.front().transmembrane_potential *= factor; });
  }
  // A run that charged with another capacitance or conductance, and one whose pulse never ended.
  const auto charged_with = [&](const std::function<void(FrozenState&)>& change) {
    damages.emplace_back([=](Numbers& n) {
      FrozenState wrong = n.end;
      change(wrong);
      n.advance(wrong);
      n.end.state.vesicles.front().transmembrane_potential = n.in_time.at_order;
    });
  };
  charged_with([](FrozenState& s) { s.model.vesicles.front().charging.capacitance *= 1.01; });
  charged_with([](FrozenState& s) { s.model.vesicles.front().charging.conductance *= 1.02; });
  charged_with([](FrozenState& s) { s.model.electric->waveform = {}; });

  std::vector<std::string> command{(fem_folder / "vehd_fem").string(),
                                   "check",
                                   run.directory / "right.h5",
                                   "--quick",
                                   "-o",
                                   run.directory / "fem",
                                   "--json",
                                   run.directory / "result.json"};
  write_numbers_of(run.directory / "right.h5", right);
  for (std::size_t i = 0; i < damages.size(); ++i) {
    Numbers wrong = right;
    damages[i](wrong);
    write_numbers_of(run.directory / ("wrong" + std::to_string(i) + ".h5"), wrong);
    command.insert(command.end(), {"--further", run.directory / ("wrong" + std::to_string(i) + ".h5")});
  }
  const ProgramResult program = run_command(command);
  BOOST_TEST(program.exit_code == 0, program.output + program.errors);
  BOOST_TEST(program.output.find("V_m in time: from time 0.4 in ") != std::string::npos, program.output);
  const nlohmann::json json = json_of(run.directory / "result.json");
  BOOST_TEST(json["in_time"]["Vm"]["verdict"].get<std::string>() == "agree", json["in_time"].dump(1));
  BOOST_TEST(json["in_time"]["begin"].get<double>() == 0.4);
  BOOST_TEST(!json["in_time"]["moves"].get<bool>());
  const double order = json["in_time"]["order_in_time"];
  // With few steps the measured order is only close to 2.
  BOOST_TEST(order > 1.5);
  BOOST_TEST(order < 2.4);
  BOOST_TEST_REQUIRE(json["further"].size() == damages.size());
  for (std::size_t i = 0; i < damages.size(); ++i) {
    const nlohmann::json& row = json["further"][i]["in_time"]["Vm"];
    BOOST_TEST(row["verdict"].get<std::string>() == "disagree", i << " " << row.dump(1));
  }
}

// The change of V_m under finer steps on the moving shape decreases with the steps of the run, to first order here. It
// is not an effect of sliding points, which would change V_m only at given (θ, φ).
BOOST_AUTO_TEST_CASE(steps_of_a_moving_shape_count_as_an_error_of_the_run) {
  const FinishedRun run(
      "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.15, 1.3]\nrotation = [0.3, 1.0, 0.2, 35.0]\n"
      "[membrane]\ncapacitance = 1.0\nconductance = 0.5\n[flow]\nkind = 'shear'\nrate = 1.0\n"
      "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
      "[numerics]\norder = 8\ndt = 0.1\nend_time = 0.6\n[output]\nevery = 0.2\n");
  const std::string file = run.output + "/run.h5";
  FrozenState end = vehd::read_frozen_state({file, {}}, "0.6");
  vehd::TimeSpan span = vehd::read_time_span(file, "0.2", end);
  BOOST_TEST_REQUIRE(span.positions.size() == 3U);
  const vehd::Vector& stored = end.state.vesicles.front().transmembrane_potential;
  const double change = vehd::change_by_finer_motion(end, span).norm() / stored.norm();
  span.control = vehd::fixed_steps(0.025);
  const double finer = vehd::change_by_finer_motion(end, span).norm() / stored.norm();
  BOOST_TEST_MESSAGE("changes " << change << " " << finer);
  BOOST_TEST(change > 1e-4);
  BOOST_TEST(change < 0.1);
  BOOST_TEST(finer > 0.15 * change);
  BOOST_TEST(finer < 0.4 * change);
  span.positions = {end.state.vesicles.front().position};
  BOOST_TEST(vehd::change_by_finer_motion(end, span).size() == 0);
}

// Regression: its points stand still, and the motion of its material was left out.
BOOST_AUTO_TEST_CASE(sphere_that_rotates_is_not_at_rest) {
  const FinishedRun run(
      "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.0, 1.0]\n[flow]\nkind = 'shear'\nrate = 1.0\n"
      "[electric]\nfield = [0.0, 0.0, 1.0]\nconductivity_in = 1.0\nconductivity_out = 1.0\n"
      "[numerics]\norder = 5\ntime_order = 3\ndt = 0.05\nend_time = 1.0\n[output]\nevery = 0.25\n");
  const std::string result = run.directory / "result.json";
  const ProgramResult check =
      run_vehd({"check", run.output + "/run.h5", "--from", "0.5", "--quick", "--no-plot", "--json", result});
  BOOST_TEST(check.exit_code == 0, check.output + check.errors);
  const nlohmann::json in_time = json_of(result)["in_time"];
  BOOST_TEST(in_time["moves"].get<bool>());
  BOOST_TEST(in_time["Vm"]["verdict"].get<std::string>() == "agree", in_time.dump(1));
}

// At this instant a sphere could leave its shape, with a velocity that its material does not follow.
BOOST_AUTO_TEST_CASE(sphere_that_an_extension_pulls_at_is_at_rest) {
  const FinishedRun run(
      "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.0, 1.0]\n"
      "[flow]\nkind = 'gradient'\ngradient = [[-0.5, 0.0, 0.0], [0.0, -0.5, 0.0], [0.0, 0.0, 1.0]]\n"
      "[electric]\nfield = [0.0, 0.0, 1.0]\nconductivity_in = 1.0\nconductivity_out = 1.0\n"
      "[numerics]\norder = 5\ntime_order = 3\ndt = 0.05\nend_time = 1.0\n[output]\nevery = 0.25\n");
  const std::string file = run.output + "/run.h5";
  FrozenState end = vehd::read_frozen_state({file, {}}, "1.0");
  BOOST_TEST(end.fields.vesicles.front().velocity.norm() > 0.1);
  BOOST_TEST(vehd::read_time_span(file, "0.5", end).positions.size() == 1U);
}

// Regression: few steps saw a field of another period, and two numbers of steps that agreed were taken for enough.
BOOST_AUTO_TEST_CASE(steps_resolve_each_period_of_the_field) {
  const FinishedRun run(
      "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.0, 1.0]\n[membrane]\nmobile = false\nconductance = 0.5\n"
      "[electric]\nfield = [0.0, 0.0, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
      "[electric.waveform]\nkind = 'burst'\nfrequency = 20.0\nstart = 0.0\nduration = 4.0\n"
      "[numerics]\norder = 4\ntime_order = 3\ndt = 0.0125\nend_time = 6.0\n[output]\ntimes = [3.0, 3.5, 3.9, 4.0]\n");
  const std::string file = run.output + "/run.h5";
  FrozenState end = vehd::read_frozen_state({file, {}}, "4.0");
  BOOST_TEST(vehd::read_time_span(file, "3.0", end).fewest_steps == 128);
  BOOST_TEST(vehd::read_time_span(file, "3.5", end).fewest_steps == 64);
  // Without a field no steps resolve it.
  FrozenState after = vehd::read_frozen_state({file, {}}, "6.0");
  BOOST_TEST(vehd::read_time_span(file, "3.5", after).fewest_steps == 64);
  BOOST_TEST(vehd::read_time_span(file, "4.0", after).fewest_steps == 4);

  const std::string result = run.directory / "result.json";
  const ProgramResult check =
      run_vehd({"check", file, "--from", "3.9", "--time", "4.0", "--quick", "--no-plot", "--json", result});
  BOOST_TEST(json_of(result)["in_time"]["steps"].get<int>() >= 16, check.output + check.errors);
  const ProgramResult refused = run_vehd({"check", file, "--from", "0", "--time", "4.0", "--quick"});
  BOOST_TEST(refused.exit_code == 1);
  BOOST_TEST(refused.errors == file +
                                   ": the field has 80 periods between --from and --time; accepted: at most 64, with "
                                   "times that are closer to each other\n");
}

// Regression: only another --time was named.
BOOST_AUTO_TEST_CASE(time_taken_instead_of_the_first_one_is_named) {
  const FinishedRun run(charging_scene);
  const std::string file = run.output + "/run.h5";
  FrozenState end = vehd::read_frozen_state({file, {}}, "1.0");
  vehd::read_time_span(file, "0.4", end);
  BOOST_TEST(end.notes.empty());
  BOOST_TEST(vehd::read_time_span(file, "0.45", end).begin == 0.4);
  BOOST_TEST_REQUIRE(end.notes.size() == 1U);
  BOOST_TEST(end.notes.front() == file + ": no snapshot at time 0.45; taken: the nearest, at 0.4");
}

// Regression: times were numbers of the scene without a unit.
BOOST_AUTO_TEST_CASE(times_of_a_run_in_si_have_their_unit) {
  const FinishedRun run("[units]\nlength = '10 um'\ntime = '10 us'\n[fluid]\nviscosity = 1.0\n" + charging_scene);
  const std::string file = run.output + "/run.h5";
  const ProgramResult refused = run_vehd({"check", file, "--from", "10 us", "--time", "6 us", "--quick"});
  BOOST_TEST(refused.errors == file +
                                   ": --from 10 us is not before the snapshot that is checked, at 0.006 ms; accepted: "
                                   "the time of an earlier snapshot\n");
  const ProgramResult check = run_vehd({"check", file, "--from", "4 us", "--quick", "--no-plot"});
  BOOST_TEST(check.output.find("run.h5 at time 0.01 ms: ") != std::string::npos, check.output + check.errors);
  BOOST_TEST(check.output.find("V_m in time: from time 0.004 ms in ") != std::string::npos, check.output);
}

BOOST_AUTO_TEST_CASE(span_that_is_none_is_refused) {
  const FinishedRun run(charging_scene);
  const std::string file = run.output + "/run.h5";
  const auto refusal = [&](const std::string& checked, const std::string& from, const std::string& time) {
    std::vector<std::string> command{"check", checked, "--from", from, "--quick"};
    if (!time.empty()) command.insert(command.end(), {"--time", time});
    const ProgramResult result = run_vehd(command);
    BOOST_TEST(result.exit_code == 1);
    return result.errors;
  };
  BOOST_TEST(refusal(file, "0.6", "0.6") ==
             file +
                 ": --from 0.6 is not before the snapshot that is checked, at 0.6; accepted: the time of an earlier "
                 "snapshot\n");
  BOOST_TEST(refusal(file, "7", "0.6").find("no snapshot near time 7") != std::string::npos);
  BOOST_TEST(refusal(run.scene, "0", "") ==
             run.scene + ": --from goes with a run; run the scene and give its run.h5\n");
}

BOOST_AUTO_TEST_SUITE_END()
