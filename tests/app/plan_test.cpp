#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "bie/estimate/cost.hpp"
#include "bie/runs/history.hpp"
#include "bie/scene/reader.hpp"
#include "tests/app/program.hpp"
#include "tests/app/stopping_scenes.hpp"

BOOST_AUTO_TEST_SUITE(plan)

namespace {

/// A scene and the summary of its run.
struct Run {
  TemporaryDirectory directory;
  std::string scene = directory / "scene.toml";
  nlohmann::json summary;

  explicit Run(const std::string& text) {
    write_text(scene, text);
    const ProgramResult run = run_vehd({"run", scene, "-o", directory / "out", "--no-plot"});
    BOOST_TEST_REQUIRE(run.exit_code == 0, run.errors);
    summary = json_of(directory / "out/summary.json");
  }
};

/// A run together with its plan.
struct PlannedRun : Run {
  nlohmann::json plan;

  explicit PlannedRun(const std::string& text) : Run(text) {
    const ProgramResult result = run_vehd({"plan", scene, "--json", directory / "plan.json"});
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    plan = json_of(directory / "plan.json");
  }
};

std::string with_numerics(const std::string& line) {
  const std::string table = "[numerics]\n";
  std::string scene = quick_scene("1.0");
  return scene.insert(scene.find(table) + table.size(), line);
}

void plan_is_what_the_run_does(const PlannedRun& run) {
  BOOST_TEST(run.summary["steps"].get<int>() == run.plan["steps"].get<int>());
  BOOST_TEST(run.summary["rejected_steps"].get<int>() == 0);
  const auto& used = run.summary["kernel_evaluations"];
  BOOST_TEST(used.size() == run.plan["operators"].size());
  const auto shapes = run.summary["steps"].get<std::uint64_t>() * run.plan["shapes_per_step"].get<std::uint64_t>() +
                      run.plan["jumps"].get<std::uint64_t>() + 1;
  const auto per_shape = run.plan["kernel_evaluations_per_shape"].get<std::uint64_t>();
  for (const auto& op : run.plan["operators"]) {
    const std::string name = op["name"];
    BOOST_REQUIRE(used.contains(name));
    BOOST_TEST(used[name].get<std::uint64_t>() == shapes * per_shape);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(run_evaluates_exactly_the_planned_kernels) {
  const PlannedRun run(quick_scene());
  plan_is_what_the_run_does(run);
  BOOST_TEST(run.plan["symmetry"].get<std::string>() == "axisymmetric about z, mirror z");
  BOOST_TEST(run.plan["operators"].size() == 4);
  BOOST_TEST(run.plan["memory_bytes"].get<double>() > 1e6);
  BOOST_TEST(run.plan["seconds_per_step"].get<double>() > 0.0);
}

BOOST_AUTO_TEST_CASE(scene_without_electricity_plans_and_evaluates_no_laplace_kernel) {
  const PlannedRun run(
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.5, 1.0, 1.0]\n[membrane]\nbending_modulus = 0.1\n"
      "[flow]\nkind = \"shear\"\nrate = 1.0\n[numerics]\norder = 6\ndt = 0.1\nend_time = 0.5\n");
  plan_is_what_the_run_does(run);
  BOOST_TEST(run.plan["operators"].size() == 1);
  BOOST_TEST(run.plan["operators"][0]["name"].get<std::string>() == "stokes_single");
  const auto& absent = run.plan["absent"];
  BOOST_TEST((std::find(absent.begin(), absent.end(), "electric field") != absent.end()));
}

BOOST_AUTO_TEST_CASE(three_equal_turns_are_planned_and_used) {
  const PlannedRun run(
      "[shape]\nkind = \"radial\"\nmodes = [{n = 3, m = 3, a = 0.2}, {n = 3, m = 0, a = 0.1}]\n[membrane]\n"
      "bending_modulus = 0.1\n[electric]\nfield = [0, 0, 0.5]\nconductivity_in = 1\nconductivity_out = 2\n"
      "[numerics]\norder = 6\ndt = 0.1\nend_time = 0.3\n");
  plan_is_what_the_run_does(run);
  BOOST_TEST(run.plan["symmetry"].get<std::string>() == "3-fold about z, mirror y");
}

BOOST_AUTO_TEST_CASE(every_order_in_time_evaluates_as_many_shapes_as_planned) {
  for (int order = 2; order <= 4; ++order) {
    plan_is_what_the_run_does(PlannedRun(with_numerics("time_order = " + std::to_string(order) + "\n")));
  }
}

// At a jump of the field the shape is evaluated for either side of it; at a kink, and after the end, it is not.
BOOST_AUTO_TEST_CASE(jumps_of_the_field_are_planned) {
  const PlannedRun run(quick_scene("1.0") +
                       "[electric.waveform]\nkind = \"table\"\ntimes = [0.0, 0.3, 0.3, 0.5, 0.75, 0.75, 2.0, 2.0]\n"
                       "values = [1.0, 1.0, 0.5, 0.5, 0.7, 0.9, 0.9, 0.0]\n");
  BOOST_TEST(run.plan["jumps"].get<int>() == 2);
  plan_is_what_the_run_does(run);
}

BOOST_AUTO_TEST_CASE(symmetry_can_be_switched_off) {
  const PlannedRun run(with_numerics("symmetry = \"off\"\n"));
  plan_is_what_the_run_does(run);
  BOOST_TEST(run.plan["symmetry"].get<std::string>() == "none");
}

BOOST_AUTO_TEST_CASE(plan_of_a_tolerance_comes_from_whole_runs) {
  std::string text = with_numerics("tolerance = 0.01\n");
  text.erase(text.find("dt ="), text.find('\n', text.find("dt =")) - text.find("dt ="));
  text.erase(text.find("order ="), text.find('\n', text.find("order =")) - text.find("order ="));
  const Run run(text);
  BOOST_TEST(run.summary["verdict"].get<std::string>() == "trustworthy");
  const vehd::Scene scene = vehd::read_scene(run.scene);
  vehd::RunPlan plan = vehd::plan_of(scene);
  vehd::predict_cost(scene, plan, {.seconds = 1e6});
  BOOST_TEST(plan.n_steps == run.summary["steps"].get<std::int64_t>());
  BOOST_TEST(plan.seconds_per_step > 0.0);
}

// A scene that cannot be stepped is reported as a finding, not as a defect of the program.
BOOST_AUTO_TEST_CASE(scene_that_cannot_be_stepped_is_a_finding) {
  const TemporaryDirectory directory;
  const std::string scene = directory / "scene.toml";
  const std::string result_file = directory / "plan.json";
  const auto finding = [&](const std::string& text, const std::vector<std::string>& options, const std::string& what) {
    write_text(scene, text);
    std::vector<std::string> arguments = {"plan", scene, "--json", result_file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = run_vehd(arguments);
    BOOST_TEST(result.exit_code == 4);
    BOOST_TEST(result.errors.starts_with(scene + ": cannot be stepped" + what), result.errors);
    return json_of(result_file);
  };
  const nlohmann::json plan = finding(stopping_scene, {}, ": no acceptable step from time 0: ");
  BOOST_TEST(plan["stops"].get<std::string>().starts_with("no acceptable step from time 0: "));
  BOOST_TEST(plan["effects"].size() == 3U);
  BOOST_TEST(plan["unknowns"].get<int>() > 0);
  BOOST_TEST(plan["seconds_per_step"].is_null());

  // The reason may be that the solves fail or that the sides are too close.
  finding(touching_membrane + "order = 6\ndt = 0.1\nend_time = 1.0\n", {}, ": ");
  finding(touching_membrane + "tolerance = 0.01\nend_time = 1.0\n", {}, ": ");
  const nlohmann::json rows =
      finding(touching_membrane + "order = 6\ndt = 0.1\nend_time = 1.0\n", {"--menu"}, " at any of these tolerances: ");
  BOOST_TEST(rows.size() == 6U);
  for (const auto& row : rows) BOOST_TEST(!row["stops"].get<std::string>().empty(), row.dump());
  const ProgramResult bench =
      run_vehd({"bench", "time", scene, "--dt", "0.1", "--at", "0.1", "-o", directory / "bench", "--no-plot"});
  BOOST_TEST(bench.exit_code == 1);
  BOOST_TEST(bench.errors.find("vehd bench: the input cannot be computed: ") != std::string::npos, bench.errors);
}

// A plan takes only steps that the run takes: none if the run has no length, one to the end if dt exceeds the run.
BOOST_AUTO_TEST_CASE(every_scene_that_runs_can_be_planned) {
  const std::string pair =
      "[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1]\n[membrane]\nbending_modulus = 0.1\n[electric]\nfield = [0, 0, "
      "10]\nconductivity_in = 1\nconductivity_out = 2\ninitial_Vm = \"steady\"\n[numerics]\n";
  const std::string vesicles = "[[vesicle]]\nshape.centre = [0, 0, -2]\n[[vesicle]]\nshape.centre = [0, 0, 2]\n";
  for (const std::string& text :
       {pair + "tolerance = 1e-2\nend_time = 0\n" + vesicles, pair + "degree = 6\ndt = 1\nend_time = 0\n" + vesicles,
        std::regex_replace(quick_scene("0.2"), std::regex("dt = 0.25"), "dt = 1e300")}) {
    const PlannedRun run(text);
    BOOST_TEST(run.plan["steps"].get<int>() == run.summary["steps"].get<int>());
    BOOST_TEST(!run.plan.contains("stops"));
    BOOST_TEST(run.plan["memory_bytes"].get<double>() > 0.0);
  }
}

// The control row of a sweep costs no more than the scene without a field, whatever the field's waveform.
BOOST_AUTO_TEST_CASE(a_field_of_zero_plans_and_evaluates_no_laplace_kernel) {
  const std::string still = std::regex_replace(quick_scene("0.5"), std::regex("field = .*"), "field = [0, 0, 0]");
  const std::string ac = "[electric.waveform]\nkind = \"ac\"\nfrequency = 1e6\n";
  const std::string displacement = std::regex_replace(still, std::regex("\n\\[numerics\\]"),
                                                      "\npermittivity = 2\ndisplacement_current = true\n[numerics]");
  for (const std::string& text : {still + ac, still + ac + "average = true\n", displacement + ac}) {
    const PlannedRun run(text);
    plan_is_what_the_run_does(run);
    BOOST_TEST(run.plan["operators"].size() == 1U);
    const vehd::HistoryTable history(run.directory / "out/history.csv");
    for (const double potential : history.column("Vm_max")) BOOST_TEST(potential == 0.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
