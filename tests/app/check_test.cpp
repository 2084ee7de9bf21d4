#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "bie/comparison/check_input.hpp"
#include "tests/app/program.hpp"

namespace {

const std::filesystem::path fem_program = std::filesystem::path(VEHD_PROGRAM).parent_path() / "vehd_fem";

bool has_finite_elements() {
  const bool available = std::filesystem::exists(fem_program);
  if (!available) BOOST_TEST_MESSAGE("skipped: the finite-element program is not built (VEHD_FEM_CHECK)");
  return available;
}

/// A shape without symmetry in a field and a shear, small enough for coarse elements; its degree resolves f_b to one
/// per cent.
const std::string crooked_scene =
    "[shape]\nkind = 'radial'\nmodes = [{n = 2, m = 1, a = 0.2}, {n = 3, m = -2, a = 0.1}]\n"
    "[membrane]\nbending_modulus = 0.1\nconductance = 5.0\n"
    "[flow]\nkind = 'shear'\nrate = 1.0\n"
    "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\ninitial_Vm = 'steady'\n"
    "[numerics]\norder = 12\ndt = 0.1\nend_time = 0.0\n";

}  // namespace

// The finite elements run one process on each processor.
BOOST_AUTO_TEST_SUITE(check, *boost::unit_test::label("slow") * boost::unit_test::label("alone") *
                                 boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(methods_agree_on_a_shape_without_symmetry) {
  if (!has_finite_elements()) return;
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", crooked_scene);
  const ProgramResult result = run_vehd(
      {"check", directory / "scene.toml", "--quick", "-o", directory / "out", "--json", directory / "result.json"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.output + result.errors);
  const nlohmann::json json = json_of(directory / "result.json");
  BOOST_TEST(json["verdict"].get<std::string>() == "agree");
  for (const char* field : {"q", "Vm", "q_steady", "force", "velocity", "velocity_own_force", "potential_inside",
                            "potential_near", "velocity_outside", "velocity_near"}) {
    BOOST_TEST_REQUIRE(json["fields"].contains(field), field);
    const auto& values = json["fields"][field];
    BOOST_TEST(values["l2"].get<double>() > 0.0, field);
    BOOST_TEST(values["l2"].get<double>() < 0.05, field << " " << values["l2"]);
    for (const char* key : {"max", "fem_error", "bie_error", "verdict"}) BOOST_TEST(values.contains(key), key);
  }
  for (const char* file : {"/surface.vtu", "/volume.vtu", "/differences.png"}) {
    BOOST_TEST(std::filesystem::file_size(directory / ("out" + std::string(file))) > 10000U, file);
  }
}

BOOST_AUTO_TEST_CASE(charge_that_is_wrong_by_a_percent_is_noticed) {
  if (!has_finite_elements()) return;
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", crooked_scene);
  const vehd::FrozenState frozen = vehd::read_frozen_state({directory / "scene.toml", {}}, std::nullopt);
  vehd::CheckProblem problem = vehd::check_problem(frozen);
  problem.contents.flow = false;
  const auto wrong_fields = [&](int order) {
    std::vector<vehd::CheckFields> fields = vehd::check_fields(problem, {order});
    fields.front().charge *= 1.01;
    return fields;
  };
  vehd::write_check_input(directory / "input.h5", {problem, wrong_fields(12), wrong_fields(18)});
  const ProgramResult result = run_command({fem_program.string(), "check", directory / "input.h5", "--quick", "-o",
                                            directory / "", "--json", directory / "result.json"});
  BOOST_TEST(result.exit_code == 0, result.errors);
  const nlohmann::json json = json_of(directory / "result.json");
  BOOST_TEST(json["verdict"] == "disagree");
  for (const auto& [field, values] : json["fields"].items()) {
    BOOST_TEST((values["verdict"] == "agree") == (field != "q"), field);
  }
}

BOOST_AUTO_TEST_CASE(mesh_is_written_with_its_quality) {
  if (!has_finite_elements()) return;
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", crooked_scene);
  for (const char* family : {"hex", "tet"}) {
    const ProgramResult result = run_vehd({"mesh", directory / "scene.toml", "--family", family, "-o",
                                           directory / "mesh.msh", "--json", directory / "mesh.json"});
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    BOOST_TEST(file_text(directory / "mesh.msh").starts_with("$MeshFormat\n4.1"));
    const nlohmann::json json = json_of(directory / "mesh.json");
    BOOST_TEST(json["smallest_scaled_jacobian"].get<double>() > 0.02, json.dump());
  }
}

BOOST_AUTO_TEST_SUITE_END()
