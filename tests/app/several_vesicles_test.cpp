#include <boost/test/unit_test.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "bie/files/run_reader.hpp"
#include "bie/runs/history.hpp"
#include "bie/scene/reader.hpp"
#include "tests/app/reference_run.hpp"

BOOST_AUTO_TEST_SUITE(several_vesicles, *boost::unit_test::label("slow"))

namespace {

const std::string two_prolates = VEHD_SOURCE_DIR "/docs/scenes/two_prolates.toml";

/// Two vesicles off axis with different fluids, in shear and field: steps of 0.1, a snapshot every 0.2.
std::string quick_pair(const std::string& end_time) {
  return "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 0.9, 1.2]\n"
         "[membrane]\nbending_modulus = 0.1\nconductance = 5.0\n"
         "[flow]\nkind = \"shear\"\nrate = 1.0\n"
         "[electric]\nfield = [0.0, 0.0, 0.5]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
         "[numerics]\norder = 6\ndt = 0.1\nend_time = " +
         end_time +
         "\n[output]\nevery = 0.2\n"
         "[[vesicle]]\nname = \"left\"\n[vesicle.shape]\ncentre = [-1.6, 0.0, 0.3]\n"
         "[[vesicle]]\nname = \"right\"\n[vesicle.shape]\ncentre = [1.4, 0.2, 0.0]\nscale = 0.8\n"
         "[vesicle.fluid]\nviscosity_ratio = 2.0\n";
}

/// Bodies without any force, pressed together by a flow.
std::string pressed_bodies(double half_distance, double dt) {
  return fmt::format(
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 0.8]\n"
      "[membrane]\ninextensible = false\n"
      "[flow]\nkind = \"axisymmetric_extension\"\nrate = -1.0\n"
      "[numerics]\ndegree = 8\ndt = {1}\nend_time = 1.6\n"
      "[[vesicle]]\nname = \"lower\"\nshape.centre = [0, 0, -{0}]\n"
      "[[vesicle]]\nname = \"upper\"\nshape.centre = [0, 0, {0}]\n",
      half_distance, dt);
}

/// Values of one vesicle in a column of vesicles.csv.
std::vector<double> of_vesicle(const vehd::HistoryTable& rows, const std::string& column, int vesicle) {
  std::vector<double> values;
  for (std::size_t i = 0; i < rows.n_rows(); ++i) {
    if (rows.column("vesicle")[i] == vesicle) values.push_back(rows.column(column)[i]);
  }
  return values;
}

void check_refused(const std::vector<std::string>& arguments, const std::string& problem) {
  const ProgramResult result = run_vehd(arguments);
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors.ends_with(problem + "\n"), result.errors);
  BOOST_TEST(std::ranges::count(result.errors, '\n') == 1, result.errors);
}

}  // namespace

// Reference: an independent axisymmetric code with errors below 1e-7; the upper vesicle at time 1. The scene allows
// higher degrees, which make no difference here.
BOOST_AUTO_TEST_CASE(two_prolates_go_where_an_axisymmetric_code_takes_them) {
  const TemporaryDirectory directory;
  const std::string output = directory / "out";
  const ProgramResult run = run_vehd(
      {"run", two_prolates, "-o", output, "--set", "numerics.end_time=1", "--set", "numerics.degree=16", "--no-plot"});
  BOOST_TEST_REQUIRE(run.exit_code == 0, run.errors);
  const vehd::HistoryTable all(output + "/history.csv"), each(output + "/vesicles.csv");
  const auto last = [&](const char* column) { return of_vesicle(each, column, 1).back(); };
  const auto is_near = [](double value, double exact) { return std::abs(value / exact - 1.0) < 1e-4; };
  BOOST_TEST(all.column("time").back() == 1.0);
  BOOST_TEST(is_near(all.column("smallest_gap").back(), 0.50785869), all.column("smallest_gap").back());
  BOOST_TEST(is_near(last("centroid_z"), 1.74922417), last("centroid_z"));
  BOOST_TEST(is_near(last("extent_z"), 2.98702709), last("extent_z"));
  BOOST_TEST(is_near(last("bending_energy_scaled"), 13.56222737), last("bending_energy_scaled"));
  BOOST_TEST(is_near(last("tension_integral"), 17.12029330), last("tension_integral"));
  BOOST_TEST(is_near(last("Vm_pole_plus"), 0.70509784), last("Vm_pole_plus"));
  BOOST_TEST(is_near(last("Vm_pole_minus"), -0.71638876), last("Vm_pole_minus"));
  const auto summary = json_of(output + "/summary.json");
  BOOST_TEST((summary.at("vesicles") == nlohmann::json{"lower", "upper"}));
}

BOOST_AUTO_TEST_CASE(a_run_goes_on_bit_for_bit) {
  const ReferenceRun run(quick_pair("0.6"));
  write_text(run.scene, quick_pair("0.2"));
  BOOST_TEST_REQUIRE(run_command(run.command).exit_code == 0);
  write_text(run.scene, quick_pair("0.6"));
  run.finish();
}

BOOST_AUTO_TEST_CASE(files_describe_every_vesicle) {
  const FinishedRun run(quick_pair("0.2"));
  const vehd::HistoryTable all(run.output + "/history.csv"), each(run.output + "/vesicles.csv");
  BOOST_TEST(all.n_rows() == 3);
  BOOST_TEST(each.n_rows() == 6);
  for (std::size_t i = 0; i < all.n_rows(); ++i) {
    const auto sum = [&](const char* column) {
      return of_vesicle(each, column, 0)[i] + of_vesicle(each, column, 1)[i];
    };
    for (const char* column : {"bending_energy_scaled", "tension_integral"}) {
      BOOST_TEST(all.column(column)[i] == sum(column));
    }
    const double worst = std::max(of_vesicle(each, "strain_max", 0)[i], of_vesicle(each, "strain_max", 1)[i]);
    BOOST_TEST(all.column("strain_max")[i] == worst);
  }
  // The right vesicle is 0.8 times as large as the left one.
  BOOST_TEST(std::abs(of_vesicle(each, "area", 1)[0] / of_vesicle(each, "area", 0)[0] - 0.64) < 1e-6);
  const vehd::RunReader snapshots(run.output + "/run.h5");
  BOOST_TEST(snapshots.n_vesicles() == 2);
  const double middle = std::sqrt(4.0 * std::numbers::pi);
  BOOST_TEST(std::abs(snapshots.snapshot(0).coefficients("x", 3, 0)(0, 0) / middle + 1.6) < 1e-12);
  BOOST_TEST(std::abs(snapshots.snapshot(0).coefficients("x", 3, 1)(0, 0) / middle - 1.4) < 1e-12);
  const std::string xdmf = file_text(run.output + "/run.xdmf");
  for (const char* place : {"/snapshots/000000/vesicles/00/surface/x", "/snapshots/000001/vesicles/01/surface/Vm"}) {
    BOOST_TEST(xdmf.find(place) != std::string::npos, place);
  }
  const ProgramResult plot = run_vehd({"plot", run.output});
  BOOST_TEST(plot.exit_code == 0, plot.errors);
}

// The mean over both would be half as large.
BOOST_AUTO_TEST_CASE(a_vesicle_that_buckles_beside_another_is_named) {
  const FinishedRun run(
      "[units]\nlength = \"10 um\"\ntime = \"1 s\"\n"
      "[shape]\nkind = \"prolate\"\nreduced_volume = 0.95\narea = \"1256 um^2\"\n"
      "[membrane]\nbending_modulus = \"2e-19 J\"\nundulations = true\ntemperature = \"298 K\"\n"
      "[fluid]\nviscosity = \"1 mPa s\"\n[numerics]\ndegree = 8\ndt = \"0.1 ms\"\nend_time = \"0.1 ms\"\n"
      "[[vesicle]]\n[[vesicle]]\nshape.centre = [4, 0, 0]\nmembrane.rest_area = \"1270 um^2\"\n");
  const auto warnings = json_of(run.output + "/summary.json").at("warnings");
  const auto buckling = std::ranges::find(warnings, "buckling", [](const auto& one) { return one.at("name"); });
  BOOST_TEST_REQUIRE((buckling != warnings.end()), warnings.dump());
  BOOST_TEST(buckling->at("value").get<double>() > 0.99);
  BOOST_TEST(buckling->at("value").get<double>() <= 1.0);
}

BOOST_AUTO_TEST_CASE(a_suspension_runs_with_its_placed_vesicles) {
  const std::string scene =
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 0.9, 1.2]\n[membrane]\nbending_modulus = 0.1\n"
      "[flow]\nkind = \"shear\"\nrate = 1.0\n[contact]\nenergy = 0.1\nrange = 0.5\n"
      "[numerics]\norder = 4\ndt = 0.1\nend_time = 0.1\n"
      "[suspension]\nkind = \"ball\"\nradius = 3\ncount = 3\n";
  const FinishedRun run(scene);
  const vehd::HistoryTable all(run.output + "/history.csv"), each(run.output + "/vesicles.csv");
  BOOST_TEST(each.n_rows() == 3 * all.n_rows());
  BOOST_TEST(all.column("effective_viscosity_intrinsic").back() != 0.0);
  const vehd::Scene placed = vehd::read_scene(run.output + "/scene.toml");
  BOOST_TEST((placed == vehd::read_scene(run.scene)));
  BOOST_TEST(file_text(run.output + "/scene.toml").find("[suspension]") == std::string::npos);
  const vehd::RunReader snapshots(run.output + "/run.h5");
  BOOST_TEST(snapshots.n_vesicles() == 3);
  BOOST_TEST(snapshots.snapshot(0).has_field("force_contact"));
}

BOOST_AUTO_TEST_CASE(commands_for_one_vesicle_say_so) {
  const FinishedRun run(quick_pair("0.0"));
  const std::string snapshots = run.output + "/run.h5";
  check_refused({"report", run.output}, "run.h5: holds 2 vesicles; vehd report accepts a run of one");
  check_refused({"bench", "symmetry", run.scene}, "scene.toml: has 2 vesicles; vehd bench accepts a scene of one");
  check_refused({"help", "groups", run.scene}, "scene.toml: has 2 vesicles; vehd help groups accepts a scene of one");
  write_text(run.scene, "[shape]\nkind = \"file\"\npath = \"out/run.h5\"\n[numerics]\ndt = 1\nend_time = 0\n");
  check_refused({"run", run.scene, "-o", run.directory / "other"}, "holds 2 vesicles; accepted: a run of one");
}

BOOST_AUTO_TEST_CASE(errors_of_a_tolerance_are_those_of_the_worst_vesicle) {
  // A sphere far from an ellipsoid that relaxes.
  const auto scene_of = [](const std::string& first, const std::string& second) {
    const auto vesicle = [](const std::string& axes, const char* centre) {
      return "[[vesicle]]\n[vesicle.shape]\naxes = " + axes + "\ncentre = [0.0, 0.0, " + centre + "]\n";
    };
    return "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.0]\n[membrane]\nbending_modulus = 1.0\n"
           "[numerics]\ntolerance = 1e-2\nend_time = 2\n" +
           vesicle(first, "-4.0") + vesicle(second, "4.0");
  };
  const std::string sphere = "[1.0, 1.0, 1.0]", ellipsoid = "[1.0, 1.0, 1.4]";
  const TemporaryDirectory directory;
  std::vector<double> errors;
  for (const std::string& text : {scene_of(sphere, ellipsoid), scene_of(ellipsoid, sphere)}) {
    write_text(directory / "scene.toml", text);
    const ProgramResult result = run_vehd({"bench", "time", directory / "scene.toml", "--tolerance", "1e-1,1e-3",
                                           "--at", "2", "--no-plot", "-o", directory / "out"});
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    const nlohmann::json row = json_of(directory / "out/time.json")["rows"][0];
    errors.push_back(row["error_bending_energy_scaled"].get<double>());
    // The error of a sphere is only rounding.
    BOOST_TEST(row["error_tension_integral"].get<double>() < 0.1);
  }
  BOOST_TEST(errors[0] > 1e-9);
  BOOST_TEST(errors[1] == errors[0], boost::test_tools::tolerance(1e-2));
}

BOOST_AUTO_TEST_CASE(plan_counts_the_kernels_of_all) {
  const FinishedRun run(quick_pair("0.2"));
  const ProgramResult result = run_vehd({"plan", run.scene, "--json", run.directory / "plan.json"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  const auto plan = json_of(run.directory / "plan.json");
  const auto used = json_of(run.output + "/summary.json").at("kernel_evaluations");
  BOOST_TEST(plan.at("operators").size() == used.size());
  for (const auto& op : plan.at("operators")) {
    const auto name = op.at("name").get<std::string>();
    const auto expected =
        3 * plan.at("kernel_evaluations_per_shape").get<std::uint64_t>() * op.at("vesicles").get<std::uint64_t>();
    BOOST_TEST(used.at(name).get<std::uint64_t>() == expected, name);
  }
  BOOST_TEST(plan.at("operators").back().at("vesicles").get<int>() == 1);
}

// Equal prolates on the axis of their field: the second one mirrors the first.
BOOST_AUTO_TEST_CASE(exchange_of_equal_vesicles_is_planned_and_mirrors_them) {
  const TemporaryDirectory directory;
  const ProgramResult planned =
      run_vehd({"plan", two_prolates, "--set", "numerics.degree=8", "--set", "numerics.tolerance=1e-1", "--set",
                "numerics.end_time=0.1", "--json", directory / "plan.json"});
  BOOST_TEST_REQUIRE(planned.exit_code == 0, planned.errors);
  const auto plan = json_of(directory / "plan.json");
  BOOST_TEST(plan.at("symmetry").get<std::string>() == "axisymmetric about z, vesicles exchanged by mirror z");
  for (const auto& op : plan.at("operators")) BOOST_TEST(op.at("vesicles").get<int>() == 1);
  const ProgramResult run =
      run_vehd({"run", two_prolates, "-o", directory / "out", "--no-plot", "--set", "numerics.end_time=0.2", "--set",
                "numerics.degree=12", "--set", "numerics.tolerance=1e-2"});
  BOOST_TEST_REQUIRE(run.exit_code == 0, run.errors);
  const vehd::HistoryTable rows(directory / "out/vesicles.csv");
  for (const char* column : {"extent_z", "tension_integral", "area"}) {
    const std::vector<double> lower = of_vesicle(rows, column, 0), upper = of_vesicle(rows, column, 1);
    for (std::size_t i = 0; i < lower.size(); ++i)
      BOOST_TEST(lower[i] == upper[i], boost::test_tools::tolerance(1e-12));
  }
  const std::vector<double> lower = of_vesicle(rows, "Vm_pole_plus", 0), upper = of_vesicle(rows, "Vm_pole_minus", 1);
  for (std::size_t i = 0; i < lower.size(); ++i) BOOST_TEST(std::abs(lower[i] + upper[i]) < 1e-12);
}

// Some of the ten vesicles are far enough apart for expansions.
BOOST_AUTO_TEST_CASE(plan_counts_the_targets_of_pairs_as_the_run_does) {
  const std::string scene =
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 0.9, 1.2]\n[membrane]\nbending_modulus = 0.1\n"
      "[numerics]\norder = 4\ndt = 0.1\nend_time = 0\n"
      "[suspension]\nkind = \"ball\"\nradius = 5\ncount = 10\n";
  for (const auto& [text, n_vesicles] : {std::pair(scene, 10), std::pair(quick_pair("0.0"), 2)}) {
    const FinishedRun run(text);
    const ProgramResult result = run_vehd({"plan", run.scene, "--json", run.directory / "plan.json"});
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    const auto planned = json_of(run.directory / "plan.json").at("pair_targets");
    BOOST_TEST((planned == json_of(run.output + "/summary.json").at("pair_targets")));
    int sum = 0;
    for (const char* way : {"near", "far", "expanded"}) sum += planned.at(way).get<int>();
    const int order = n_vesicles == 10 ? 4 : 6;
    BOOST_TEST(sum == n_vesicles * (n_vesicles - 1) * 2 * (order + 1) * (order + 1));
    BOOST_TEST((planned.at("expanded") > 0) == (n_vesicles == 10));
  }
}

BOOST_AUTO_TEST_CASE(a_run_at_its_limit_says_which_two_where_and_how_near) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", pressed_bodies(0.8008, 0.1));
  const ProgramResult run = run_vehd({"run", directory / "scene.toml", "-o", directory / "out", "--no-plot"});
  BOOST_TEST(run.exit_code == 3);
  const auto summary = json_of(directory / "out/summary.json");
  const auto verdict = summary.at("verdict").get<std::string>();
  BOOST_TEST(verdict.starts_with("stopped: no acceptable step from time "), verdict);
  BOOST_TEST(verdict.find(": vesicles \"lower\" and \"upper\" come within 0.001 radii of each other at "
                          "(0, 0, 0); accepted: at least 0.001, ") != std::string::npos,
             verdict);
  BOOST_TEST(verdict.find("smallest_gap needs a higher degree than 8 since time 0 ") != std::string::npos, verdict);
  BOOST_TEST(summary.at("smallest_gap").get<double>() > 0.9e-3);
}

BOOST_AUTO_TEST_SUITE_END()
