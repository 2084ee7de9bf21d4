#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bie/files/run_reader.hpp"
#include "bie/runs/history.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/reader.hpp"
#include "tests/app/reference_run.hpp"

namespace {

/// A short pulse on a giant vesicle: 8 steps of 25 us, more while it lasts.
std::string pulse(const std::string& output = "", const std::string& end_time = "200 us") {
  return "[units]\ntemperature = \"298 K\"\n"
         "[shape]\nkind = \"prolate\"\nreduced_volume = 0.95\narea = \"1257 um^2\"\n"
         "[membrane]\nbending_modulus = \"25 kBT\"\ncapacitance = \"10 mF/m^2\"\n"
         "[fluid]\nviscosity = \"1 mPa s\"\n"
         "[electric]\nfield = [0, 0, \"1 kV/cm\"]\nconductivity_in = \"0.5 mS/cm\"\nconductivity_out = \"1 mS/cm\"\n"
         "permittivity = \"80 eps0\"\n"
         "[electric.waveform]\nkind = \"pulse\"\nduration = \"50 us\"\n"
         "[numerics]\norder = 6\ndt = \"25 us\"\nend_time = \"" +
         end_time + "\"\n[output]\nevery = \"100 us\"\n" + output;
}

struct SiRun {
  TemporaryDirectory directory;

  std::string run(const std::string& name, const std::string& text, const std::vector<std::string>& more = {}) const {
    const std::string scene = directory / (name + ".toml"), output = directory / name;
    write_text(scene, text);
    std::vector<std::string> command = {"run", scene, "-o", output, "--no-plot", "--quiet"};
    command.insert(command.end(), more.begin(), more.end());
    const ProgramResult result = run_vehd(command);
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    printed = result.output;
    return output;
  }
  mutable std::string printed;
};

/// First word of a message is a path of a temporary folder.
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

BOOST_AUTO_TEST_SUITE(si_output)

BOOST_FIXTURE_TEST_CASE(units_change_the_output_and_nothing_of_the_run, SiRun) {
  const std::string shown = run("shown", pulse()), plain = run("plain", pulse("units = \"dimensionless\"\n"));
  const vehd::HistoryTable si(shown + "/history.csv"), numbers(plain + "/history.csv");
  const vehd::OutputUnits units(vehd::read_scene(shown + "/scene.toml"));
  BOOST_TEST(si.header("time") == "time [ms]");
  BOOST_TEST(si.header("extent_z") == "extent_z [um]");
  BOOST_TEST(si.header("reduced_volume") == "reduced_volume");
  BOOST_TEST(numbers.header("time") == "time");
  BOOST_TEST_REQUIRE(si.n_rows() == numbers.n_rows());
  for (const vehd::HistoryColumn& column : vehd::history_columns()) {
    const double factor = units.of(column.dimension).factor;
    const auto &a = si.column(std::string(column.name)), &b = numbers.column(std::string(column.name));
    for (std::size_t i = 0; i < a.size(); ++i) BOOST_TEST(a[i] == b[i] * factor, column.name);
  }
  // Every number of every snapshot is the same.
  const auto data = snapshot_data(shown + "/run.h5"), reference = snapshot_data(plain + "/run.h5");
  BOOST_TEST_REQUIRE(data.size() == reference.size());
  for (std::size_t i = 0; i < data.size(); ++i) BOOST_TEST((data[i].second == reference[i].second), data[i].first);
}

// The reference scales must not change the SI columns; a column with a wrong dimension would change with them.
BOOST_FIXTURE_TEST_CASE(a_history_in_si_does_not_depend_on_the_reference_scales, SiRun) {
  std::string tilted = pulse();
  const auto replace = [&](const std::string& from, const std::string& to) {
    tilted.replace(tilted.find(from), from.size(), to);
  };
  // No column vanishes by symmetry.
  replace("field = [0, 0, \"1 kV/cm\"]", "field = [\"0.03 kV/cm\", 0, \"0.09 kV/cm\"]");
  replace("area = ", "centre = [\"5 um\", \"2 um\", \"3 um\"]\narea = ");
  tilted += "[flow]\nkind = \"shear\"\nrate = \"100 1/s\"\n";
  std::string other = tilted;
  other.insert(other.find("temperature"),
               "length = \"3 um\"\ntime = \"70 us\"\nviscosity = \"20 mPa s\"\npotential = \"0.3 V\"\n");
  const vehd::HistoryTable a(run("a", tilted) + "/history.csv"), b(run("b", other) + "/history.csv");
  BOOST_TEST_REQUIRE(a.n_rows() == b.n_rows());
  for (const vehd::HistoryColumn& column : vehd::history_columns()) {
    const std::string name(column.name);
    BOOST_TEST(a.header(name) == b.header(name));
    // Columns that consist of solver and rounding errors.
    if (name.starts_with("iterations") || name.find("drift") != std::string::npos || name == "strain_max" ||
        name == "raw_area") {
      continue;
    }
    double size = a.largest_magnitude(name);
    // The error of a component is relative to the largest one.
    const std::string stem = name.substr(0, name.rfind('_') + 1);
    const bool is_vector = name.starts_with("centroid") || name.starts_with("dipole");
    if (is_vector || name.starts_with("stress") || name.starts_with("shape_mode")) {
      for (const char* entry : {"x", "y", "z", "xx", "yy", "zz", "xy", "xz", "yz", "2"}) {
        if (a.has(stem + entry)) size = std::max(size, a.largest_magnitude(stem + entry));
      }
    }
    // Remainders of sums that nearly cancel have fewer digits.
    const double bound = name == "quadrature_error" ? 1e-3 : 1e-6;
    for (std::size_t i = 0; i < a.n_rows(); ++i) {
      const double x = a.column(name)[i], y = b.column(name)[i];
      BOOST_TEST((std::abs(x - y) <= bound * size || x == y || (std::isnan(x) && std::isnan(y))),
                 a.header(name) << " row " << i << ": " << x << " and " << y);
    }
  }
}

BOOST_FIXTURE_TEST_CASE(numbers_are_those_of_the_experiment, SiRun) {
  const std::string output = run("run", pulse());
  const vehd::HistoryTable history(output + "/history.csv");
  BOOST_TEST(history.column("time").back() == 0.2, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(history.column("area").front() == 1257.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(history.header("Vm_pole_plus") == "Vm_pole_plus [mV]");
  BOOST_TEST(has(printed, "completed at time 0.2 ms: "));
  const auto summary = json_of(output + "/summary.json");
  BOOST_TEST(summary.at("time").get<double>() == 0.2, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(summary.at("units").at("time").get<std::string>() == "ms");
  const vehd::Hdf5Reader file(output + "/run.h5");
  BOOST_TEST(file.text_attribute("/snapshots/000000/x", "unit") == "m");
  const double radius = std::sqrt(1257e-12 / (4.0 * std::acos(-1.0)));
  BOOST_TEST(file.number_attribute("/snapshots/000000/x", "scale") == radius, boost::test_tools::tolerance(1e-12));
}

// The first step is 3e-13 of the run.
BOOST_FIXTURE_TEST_CASE(a_membrane_that_charges_in_nanoseconds_may_be_followed_for_an_hour, SiRun) {
  const std::string scene =
      "[units]\nlength = \"1 um\"\n[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 2]\n"
      "[membrane]\nbending_modulus = \"1e-19 J\"\ncapacitance = \"10 mF/m^2\"\n"
      "[fluid]\nviscosity = \"1 mPa s\"\n"
      "[electric]\nfield = [0, 0, \"10 V/m\"]\nconductivity_in = \"3 S/m\"\nconductivity_out = \"1 S/m\"\n"
      "permittivity = \"80 eps0\"\n[numerics]\ndegree = 16\ntolerance = 1e-2\nend_time = \"3600 s\"\n";
  const vehd::HistoryTable history(run("hour", scene) + "/history.csv");
  BOOST_TEST(history.column("dt")[1] < 3600.0 * 1e-9);
  BOOST_TEST(history.column("Vm_pole_plus").back() != 0.0);
}

BOOST_FIXTURE_TEST_CASE(a_dimensionless_run_names_no_unit, SiRun) {
  const std::string output = run("run", quick_scene("0.5"));
  BOOST_TEST(json_of(output + "/summary.json").at("units").at("time").get<std::string>() == "1");
  BOOST_TEST(has(printed, "completed at time 0.5: "));
  BOOST_TEST(!has(file_text(output + "/history.csv"), "["));
}

BOOST_FIXTURE_TEST_CASE(a_run_goes_on_in_the_units_of_its_history, SiRun) {
  const std::string begun = run("run", pulse("", "200 us"));
  const std::string text = file_text(begun + "/history.csv");
  run("run", pulse("", "1200 us"), {"--resume"});
  const vehd::HistoryTable history(begun + "/history.csv");
  BOOST_TEST(file_text(begun + "/history.csv").starts_with(text));
  BOOST_TEST(history.header("time") == "time [ms]");
  BOOST_TEST(history.column("time").back() == 1.2, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(has(printed, "completed at time 1.2 ms: "));
  write_text(directory / "run.toml", pulse("units = \"dimensionless\"\n", "1200 us"));
  const ProgramResult refused = run_vehd({"run", directory / "run.toml", "-o", begun, "--resume"});
  BOOST_TEST(refused.exit_code == 1);
  BOOST_TEST(has(refused.errors, "\"output.units\" is \"dimensionless\", but the run in "));
  BOOST_TEST(has(refused.errors, "history.csv keeps the units of its first session"));
}

BOOST_FIXTURE_TEST_CASE(a_stopped_si_run_continues_bit_for_bit, SiRun) {
  const RunPair pair(pulse());
  pair.run_reference();
  // The run ends half way and is continued.
  write_text(pair.scene, pulse("", "100 us"));
  BOOST_TEST_REQUIRE(run_command(pair.command).exit_code == 0);
  write_text(pair.scene, pulse());
  BOOST_TEST_REQUIRE(run_command(pair.command).exit_code == 0);
  BOOST_TEST((file_text(pair.output + "/history.csv") == file_text(pair.reference + "/history.csv")));
}

BOOST_FIXTURE_TEST_CASE(snapshots_come_often_during_a_pulse_and_seldom_after_it, SiRun) {
  const std::string output = run("run", pulse("times = [\"70 us\"]\n[[output.window]]\nfrom = 0\nto = \"50 us\"\n"
                                              "every = \"10 us\"\n"));
  const vehd::RunReader file(output + "/run.h5");
  const double scale = vehd::Hdf5Reader(output + "/run.h5").number_attribute("/snapshots", "time_scale");
  std::vector<long> us;
  for (const double time : file.times()) us.push_back(std::lround(time * scale * 1e6));
  BOOST_TEST(us == (std::vector<long>{0, 10, 20, 30, 40, 50, 70, 100, 200}), boost::test_tools::per_element());
  // Steps: 5 in the window, one to 70, two to 100, four to 200.
  BOOST_TEST(vehd::HistoryTable(output + "/history.csv").n_steps() == 12);
}

BOOST_FIXTURE_TEST_CASE(pictures_of_a_run_in_si_are_drawn, SiRun) {
  const std::string output = run("run", pulse());
  const ProgramResult result = run_vehd({"plot", output});
  BOOST_TEST(result.exit_code == 0, result.errors);
  BOOST_TEST(result.errors == "");
  for (const char* picture : {"/plots/shapes.png", "/plots/history.png"}) {
    BOOST_TEST(std::filesystem::file_size(output + picture) > 10000U);
  }
}

BOOST_FIXTURE_TEST_CASE(a_plan_prints_groups_and_times_in_si, SiRun) {
  write_text(directory / "scene.toml", pulse());
  const ProgramResult result = run_vehd({"plan", directory / "scene.toml", "--json", directory / "plan.json"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  const auto plan = json_of(directory / "plan.json");
  std::map<std::string, nlohmann::json> times, groups;
  for (const auto& time : plan.at("times")) times[time.at("symbol").get<std::string>()] = time;
  for (const auto& group : plan.at("groups")) groups[group.at("symbol").get<std::string>()] = group;
  const double relaxation = 3.0 * 80.0 * 8.8541878188e-12 / (0.05 + 2.0 * 0.1);
  BOOST_TEST(times.at("t_MW").at("seconds").get<double>() == relaxation, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(times.at("t_end").at("seconds").get<double>() == 2e-4, boost::test_tools::tolerance(1e-9));
  for (const char* symbol : {"t_m", "t_el", "t_κ"}) BOOST_TEST(!times.at(symbol).at("meaning").empty());
  BOOST_TEST(groups.at("v").at("value").get<double>() == 0.95, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(groups.contains("Ca"));
  BOOST_TEST(has(result.output, "Maxwell–Wagner time"));
  BOOST_TEST(has(result.output, "200 us"));
}

BOOST_FIXTURE_TEST_CASE(physics_outside_the_model_is_said_apart_from_the_verdict, SiRun) {
  const std::vector<std::string> more = {"--set", "electric.field=[0, 0, \"3 kV/cm\"]", "--set",
                                         "membrane.mobile=false"};
  const std::string output = run("strong", pulse(), more);
  const nlohmann::json summary = json_of(output + "/summary.json");
  BOOST_TEST(summary["verdict"] == "trustworthy");
  BOOST_TEST_REQUIRE(!summary["warnings"].empty());
  const nlohmann::json& warning = summary["warnings"][0];
  BOOST_TEST(warning["name"] == "poration");
  BOOST_TEST(warning["limit"] == 1.0);
  const vehd::HistoryTable history(output + "/history.csv");
  BOOST_TEST(history.unit("Vm_max") == "mV");
  BOOST_TEST(1e3 * warning["value"].get<double>() == history.largest_magnitude("Vm_max"),
             boost::test_tools::tolerance(1e-12));
  const auto text = warning["text"].get<std::string>();
  BOOST_TEST(has(printed, "outside the model (poration): " + text + "\n"));
  const ProgramResult report = run_vehd({"report", output, "-o", output + "/report.html"});
  BOOST_TEST(report.exit_code == 0, report.errors);
  BOOST_TEST(has(file_text(output + "/report.html"), "\"warnings\":[\"" + text));
  std::vector<std::string> command = {"plan", directory / "strong.toml", "--json", output + "/plan.json"};
  command.insert(command.end(), more.begin(), more.end());
  const ProgramResult plan = run_vehd(command);
  BOOST_TEST(has(plan.output, "outside the model, by estimates for a sphere\n  poration"));
  // A prolate along the field charges a little less than the sphere.
  const nlohmann::json planned = json_of(output + "/plan.json")["warnings"][0];
  BOOST_TEST(planned["name"] == "poration");
  BOOST_TEST(planned["value"].get<double>() == warning["value"].get<double>(), boost::test_tools::tolerance(0.2));
}

BOOST_AUTO_TEST_SUITE_END()
