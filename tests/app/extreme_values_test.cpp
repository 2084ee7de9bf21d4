#include <boost/test/unit_test.hpp>
#include <map>
#include <string>

#include "tests/app/program.hpp"

namespace {

/// A scene of two steps, order 4, whose values can be replaced.
class ExtremeScene {
 public:
  ExtremeScene& set(const std::string& key, const std::string& value) {
    values_[key] = value;
    return *this;
  }
  [[nodiscard]] std::string text() const {
    const auto line = [&](const char* key) { return std::string(key) + " = " + values_.at(key) + "\n"; };
    return "[shape]\nkind = \"radial\"\nmodes = [{n = 2, m = 0, a = 0.2}]\n" + line("base") + line("amplitude") +
           line("exponent") + "[membrane]\n" + line("bending_modulus") + line("capacitance") + line("conductance") +
           "[fluid]\n" + line("viscosity") + "[electric]\n" + line("field") + line("conductivity_in") +
           line("conductivity_out") + "[flow]\nkind = \"shear\"\n" + line("rate") + "[numerics]\ndegree = 4\n" +
           line("dt") + line("end_time");
  }

 private:
  std::map<std::string, std::string> values_{
      {"base", "1.0"},        {"amplitude", "0.1"},   {"exponent", "1.0"},        {"bending_modulus", "0.2"},
      {"capacitance", "1.0"}, {"conductance", "0.5"}, {"viscosity", "1.0"},       {"field", "[0.0, 0.0, 0.8]"},
      {"rate", "0.5"},        {"dt", "0.05"},         {"conductivity_in", "2.0"}, {"conductivity_out", "1.0"},
      {"end_time", "0.1"}};
};

/// Checks how a run ends: a refused scene leaves no run, and a run that stops gives its reason in words and can be
/// continued.
void check_promises(const std::string& scene) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", scene);
  const std::vector<std::string> command = {
      "run", directory / "scene.toml", "-o", directory / "out", "--quiet", "--no-plot", "--resume"};
  const ProgramResult first = run_vehd(command);
  BOOST_TEST((first.exit_code == 0 || first.exit_code == 1 || first.exit_code == 3), first.exit_code << scene);
  BOOST_TEST((first.exit_code == 0 || !first.errors.empty()), scene);
  if (first.exit_code == 1) BOOST_TEST(!std::filesystem::exists(directory / "out/checkpoint.h5"), scene);
  if (first.exit_code != 3) return;
  BOOST_TEST(first.errors.find(": ;") == std::string::npos, first.errors << scene);
  BOOST_TEST(first.errors.find("continue") != std::string::npos, first.errors << scene);
  BOOST_TEST(!json_of(directory / "out/summary.json").at("reason").get<std::string>().empty(), scene);
  const ProgramResult second = run_vehd(command);
  BOOST_TEST((second.exit_code == 0 || second.exit_code == 3), second.errors << scene);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(extreme_values, *boost::unit_test::label("slow"))

BOOST_AUTO_TEST_CASE(of_a_scene_end_a_run_that_can_be_continued_or_are_refused) {
  for (const std::string key : {"base", "amplitude", "exponent", "bending_modulus", "capacitance", "conductance",
                                "viscosity", "rate", "conductivity_in"}) {
    for (const std::string value : {"1e-300", "1e-80", "500.0", "1e40", "1e120", "1e300"}) {
      check_promises(ExtremeScene().set(key, value).text());
    }
  }
  for (const std::string value : {"1e-160", "1e60", "1e160"}) {
    check_promises(ExtremeScene().set("field", "[0.0, 0.0, " + value + "]").text());
  }
}

BOOST_AUTO_TEST_CASE(a_shape_without_a_finite_size_is_refused_with_its_line) {
  for (const std::string exponent : {"800.0", "8000.0"}) {
    const TemporaryDirectory directory;
    write_text(directory / "scene.toml", ExtremeScene().set("amplitude", "1.0").set("exponent", exponent).text());
    for (const char* command : {"plan", "run"}) {
      const ProgramResult result = run_vehd({command, directory / "scene.toml"});
      BOOST_TEST(result.exit_code == 1);
      const bool is_named = result.errors.find("scene.toml:3: the radius in [shape] is") != std::string::npos ||
                            result.errors.find("the radius in [shape] falls to") != std::string::npos;
      BOOST_TEST(is_named, result.errors);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_step_lost_in_the_rounding_of_the_end_is_named) {
  const TemporaryDirectory directory;
  std::string scene = ExtremeScene().set("end_time", "1e300").text();
  scene.replace(scene.find("dt = 0.05"), 9, "tolerance = 1e-3");
  check_promises(scene);
  write_text(directory / "scene.toml", scene);
  const ProgramResult result =
      run_vehd({"run", directory / "scene.toml", "-o", directory / "out", "--quiet", "--no-plot"});
  BOOST_TEST(result.exit_code == 3);
  BOOST_TEST(result.errors.find("are lost in the rounding of end_time") != std::string::npos, result.errors);
}

BOOST_AUTO_TEST_SUITE_END()
