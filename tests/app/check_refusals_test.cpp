#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "bie/comparison/check_input.hpp"
#include "bie/files/run_reader.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/reference_run.hpp"
#include "tests/support/run_damage.hpp"

using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(check_refusals, *boost::unit_test::precondition(finite_elements_are_built) *
                                          boost::unit_test::label("slow") * boost::unit_test::label("once"))

namespace {

const std::filesystem::path elements = finite_element_program();

/// Scales a field of a run and renews its checksums, as if a program had computed the field wrongly.
void scale_field_of_run(const std::string& path, const std::string& group, const std::string& field, double factor) {
  {
    const vehd::Hdf5Handle file = open_for_damage(path);
    for (const std::string_view part : vehd::snapshot_parts) {
      change_dataset(file.id(), group + "/" + std::string(part) + field, [=](double value) { return factor * value; });
    }
  }
  reseal(path, group);
  // The checkpoint still refers to the snapshots as they were.
  std::filesystem::remove(std::filesystem::path(path).parent_path() / "checkpoint.h5");
}

const std::string moving_scene =
    "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.1, 1.25]\n[membrane]\nbending_modulus = 0.1\nconductance = 5.0\n"
    "spontaneous_curvature = -0.3\n"
    "[flow]\nkind = 'shear'\nrate = 1.0\n"
    "[electric]\nfield = [0.0, 0.2, 0.5]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
    "[numerics]\norder = 10\ndt = 0.1\nend_time = 0.0\n";

}  // namespace

BOOST_AUTO_TEST_CASE(stored_number_that_is_wrong_by_a_percent_is_noticed) {
  const FinishedRun run(moving_scene);
  const std::string file = run.output + "/run.h5";
  scale_field_of_run(file, "/snapshots/000000", "tension", 1.01);
  scale_field_of_run(file, "/snapshots/000000", "velocity", 1.01);
  const ProgramResult wrong =
      run_vehd({"check", file, "--quick", "--ranks", "1", "--no-plot", "--json", run.directory / "result.json"});
  BOOST_TEST(wrong.exit_code == 4);
  BOOST_TEST(wrong.errors.find("disagree in: stored lambda, stored v") != std::string::npos, wrong.errors);
  const nlohmann::json result = json_of(run.directory / "result.json");
  for (const auto& [row, values] : result["stored"].items()) {
    const bool is_damaged = row == "tension" || row == "velocity";
    BOOST_TEST((values["verdict"] == "disagree") == is_damaged, row);
  }
}

// Regression: ended with "internal error: filesystem error: cannot remove".
BOOST_AUTO_TEST_CASE(output_that_is_a_file_or_below_one_is_refused) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", moving_scene);
  write_text(directory / "file", "");
  for (const std::string& output : {directory / "file", directory / "file/out"}) {
    const ProgramResult result = run_vehd({"check", directory / "scene.toml", "-o", output});
    BOOST_TEST(result.exit_code == 1, output);
    BOOST_TEST(result.errors == output + ": cannot be used as output directory: Not a directory\n");
  }
}

BOOST_AUTO_TEST_CASE(snapshot_that_lost_its_seal_is_refused) {
  const FinishedRun run;
  const std::string file = run.output + "/run.h5";
  {
    const vehd::Hdf5Handle damaged = open_for_damage(file);
    BOOST_TEST_REQUIRE(H5Ldelete(damaged.id(), "/snapshots/000001/seal", H5P_DEFAULT) >= 0);
  }
  const ProgramResult result = run_vehd({"check", file, "--time", "0.5", "--quick"});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors == file + ": /snapshots/000001 has lost its seal, /snapshots/000001/seal\n");
}

BOOST_AUTO_TEST_CASE(input_without_compared_fields_is_refused) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", moving_scene);
  const vehd::FrozenState frozen = vehd::read_frozen_state({directory / "scene.toml", {}}, std::nullopt);
  vehd::CheckProblem problem = vehd::check_problem(frozen);
  problem.samples = {};
  const std::vector<vehd::CheckFields> fields = vehd::check_fields(problem, {10});
  const std::string file = directory / "input.h5";
  const auto refused = [&](const std::string& object, const std::string& message) {
    vehd::write_check_input(file, {problem, fields, fields});
    {
      const vehd::Hdf5Handle damaged = open_for_damage(file);
      BOOST_TEST_REQUIRE(H5Ldelete(damaged.id(), object.c_str(), H5P_DEFAULT) >= 0);
    }
    const ProgramResult result = run_command({elements.string(), "check", file, "--quick", "-o", directory / "out"});
    BOOST_TEST(result.exit_code == 1, object);
    BOOST_TEST(result.errors == file + ": " + message + "\n");
  };
  refused("/bie/q", "dataset /bie/q is missing or damaged");
  refused("/bie_high/velocity", "dataset /bie_high/velocity is missing or damaged");
  refused("/bie/tension", "dataset /bie/tension is missing or damaged");
  refused("/bie_high/force_curvature", "has a spontaneous curvature and no force_curvature in /bie or /bie_high");
  refused("/stored/q", "dataset /stored/q is missing or damaged");
  refused("/bie", "attribute order of /bie is missing or damaged");
  refused("/given", "has neither /given/Vm nor /given/force: nothing to compare");
}

BOOST_AUTO_TEST_SUITE_END()
