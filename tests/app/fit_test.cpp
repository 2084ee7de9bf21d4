#include <boost/test/unit_test.hpp>
#include <csignal>

#include "bie/scene/reader.hpp"
#include "tests/app/program.hpp"
#include "tests/support/waiting.hpp"

BOOST_AUTO_TEST_SUITE(fits, *boost::unit_test::label("once"))

namespace {

namespace fs = std::filesystem;

/// A quick scene, synthetic measurements of it, and a fit.
struct FitWork {
  TemporaryDirectory directory;
  std::string scene = VEHD_SOURCE_DIR "/docs/fits/charging_scene.toml", data = directory / "charging.csv",
              file = directory / "fit.toml", output = directory / "out";

  FitWork() {
    BOOST_TEST_REQUIRE(make_data(data, "1").exit_code == 0);
    write_text(file, "[[experiment]]\nscene = \"" + scene + "\"\ndata = \"" + data +
                         "\"\nquantity = \"Vm_north\"\n[free]\n"
                         "\"membrane.capacitance\" = {from = \"0.2 uF/cm^2\", to = \"5 uF/cm^2\"}\n");
  }

  [[nodiscard]] ProgramResult make_data(const std::string& to, const std::string& seed) const {
    return run_vehd({"synthesise", scene, "-o", to, "--quantity", "Vm_north", "--noise", "10 mV", "--seed", seed,
                     "--set", "output.every=0.2 ms", "--quiet"});
  }
  [[nodiscard]] std::vector<std::string> command(const std::string& place = "") const {
    return vehd_command({"fit", file, "-o", place.empty() ? output : place, "--jobs", "1", "--quiet"});
  }
};

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_fit_of_synthetic_data_finds_the_values_of_the_scene, FitWork) {
  const ProgramResult result = run_command(command());
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  const nlohmann::json json = json_of(output + "/fit.json");
  const double capacitance = json["values"]["membrane.capacitance"], error = json["errors"]["membrane.capacitance"];
  BOOST_TEST(std::abs(capacitance - 0.8) < 3.5 * error);
  BOOST_TEST(error < 0.05);
  BOOST_TEST(json["units"]["membrane.capacitance"] == "uF/cm^2");
  BOOST_TEST(json["verdicts"]["charging"] == nlohmann::json({"trustworthy"}));
  BOOST_TEST(result.output.find("membrane.capacitance") != std::string::npos, result.output);
  // One row for each of six times, and the header.
  const std::string table = file_text(output + "/fit.csv");
  BOOST_TEST(std::ranges::count(table, '\n') == 7);
  BOOST_CHECK_NO_THROW(vehd::read_scene(output + "/best.toml"));
}

// Regression: the aspect ratio along a zero field was 0.
BOOST_FIXTURE_TEST_CASE(a_quantity_that_is_not_a_number_is_refused, FitWork) {
  const auto made = [&](const std::string& name, const std::string& field) {
    return run_vehd({"synthesise", scene, "-o", directory / name, "--quantity", "aspect_ratio_field", "--noise", "0.01",
                     "--seed", "1", "--set", "numerics.end_time=0.1 ms", "--set", field, "--quiet"});
  };
  BOOST_TEST(made("zero.csv", "electric.field_magnitude=0").exit_code == 0);
  const ProgramResult refused = made("none.csv", "electric.field=[0, 0, 0]");
  BOOST_TEST(refused.exit_code == 1);
  BOOST_TEST(refused.errors.find("\"aspect_ratio_field\" is not a number") != std::string::npos, refused.errors);
}

BOOST_FIXTURE_TEST_CASE(data_are_those_of_their_seed, FitWork) {
  const std::string same = directory / "new/same.csv", other = directory / "other.csv";
  BOOST_TEST(make_data(same, "1").exit_code == 0);
  BOOST_TEST(make_data(other, "2").exit_code == 0);
  BOOST_TEST(file_text(same) == file_text(data));
  BOOST_TEST(file_text(other) != file_text(data));
  BOOST_TEST(file_text(data).starts_with("time [ms],Vm_north [mV],deviation [mV]\n0,"), file_text(data));
}

BOOST_FIXTURE_TEST_CASE(noise_that_runs_do_not_reach_is_refused, FitWork) {
  const ProgramResult result = run_vehd(
      {"synthesise", scene, "-o", directory / "exact.csv", "--quantity", "Vm_north", "--noise", "1e-9 mV", "--quiet"});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(
      result.errors.starts_with("--noise: is too small for runs; accepted: more than 1e-07 of the largest value"),
      result.errors);
}

BOOST_FIXTURE_TEST_CASE(data_replace_no_file, FitWork) {
  write_text(directory / "measured.csv", "mine");
  const ProgramResult result = make_data(directory / "measured.csv", "1");
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors.find("measured.csv: exists already; accepted: a new file") != std::string::npos,
             result.errors);
  BOOST_TEST(file_text(directory / "measured.csv") == "mine");
}

BOOST_FIXTURE_TEST_CASE(a_signal_leaves_a_fit_that_goes_on, FitWork) {
  const std::string undisturbed = directory / "undisturbed";
  BOOST_TEST_REQUIRE(run_command(command(undisturbed)).exit_code == 0);
  RunningProgram program(command());
  BOOST_TEST(comes_true([&] { return program.ended() || fs::exists(output + "/runs"); }, std::chrono::seconds(60)));
  program.send(SIGINT);
  const ProgramResult stopped = program.wait();
  BOOST_TEST(stopped.exit_code == 3, stopped.errors);
  BOOST_TEST(!fs::exists(output + "/fit.json"));
  BOOST_TEST(run_command(command()).exit_code == 0);
  for (const char* name : {"/fit.json", "/fit.csv", "/best.toml"}) {
    BOOST_TEST(file_text(output + name) == file_text(undisturbed + name));
  }
}

BOOST_FIXTURE_TEST_CASE(mistakes_of_options_are_said, FitWork) {
  const auto refusal = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"synthesise", scene, "-o", data, "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run_vehd(words);
    BOOST_TEST(result.exit_code == 1);
    return result.errors;
  };
  BOOST_TEST(refusal({"--quantity", "Vm_nort", "--noise", "1 mV"}).find("did you mean \"Vm_north\"?") !=
             std::string::npos);
  BOOST_TEST(refusal({"--quantity", "Vm_north", "--noise", "1 um"})
                 .starts_with("--noise 1 um: has the unit \"um\" for a potential"));
  BOOST_TEST(
      refusal({"--quantity", "Vm_north", "--noise", "0 mV"}).starts_with("--noise 0 mV: accepted: a number above 0"));
  BOOST_TEST(
      refusal({"--quantity", "Vm_north", "--noise", "1 mV", "--vary", "flow.rat=1,2"}).find("did you mean \"rate\"?") !=
      std::string::npos);
  BOOST_TEST(refusal({"--quantity", "Vm_north", "--noise", "1 mV", "--vary", "flow.rate"})
                 .starts_with("--vary flow.rate: accepted: table.key=VALUE"));
  BOOST_TEST(refusal({"--quantity", "Vm_north", "--noise", "1 mV", "--vary", "membrane.capacitance=0.5,0.6"})
                 .starts_with("--vary membrane.capacitance: has no unit for a capacitance/area"));
  BOOST_TEST(refusal({"--quantity", "time", "--noise", "1 ms"}).find("\"quantity\" is \"time\"") != std::string::npos);
  for (const char* option : {"--angles=8", "--pixel=1 um"}) {
    BOOST_TEST(refusal({"--quantity", "Vm_north", "--noise", "1 mV", option})
                   .starts_with("--quantity Vm_north: has no angles and pixels; accepted with --"));
  }
  BOOST_TEST(refusal({"--quantity", "Vm_north", "--noise", "1 mV", "--seed=-1"}).find("-1 is below 0") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
