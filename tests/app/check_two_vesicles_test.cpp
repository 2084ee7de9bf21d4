#include <fmt/format.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/app/check_numbers.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/reference_run.hpp"

// The finite elements run one process on each processor.
BOOST_AUTO_TEST_SUITE(check_two_vesicles, *boost::unit_test::precondition(finite_elements_are_built) *
                                              boost::unit_test::label("slow") * boost::unit_test::label("extended") *
                                              boost::unit_test::label("once"))

namespace {

using vehd::CheckFields;
using vehd::FrozenState;
using vehd::Matrix;

/// Two vesicles without symmetry and with different materials, in a field and a shear.
/// @param distance  between the centres
std::string scene_text(double distance) {
  return fmt::format(
      "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.15, 1.3]\nrotation = [0.3, 1.0, 0.2, 35.0]\n"
      "[membrane]\nbending_modulus = 0.1\ncapacitance = 1.0\nconductance = 0.5\n"
      "[flow]\nkind = 'shear'\nrate = 1.0\n"
      "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\ninitial_Vm = 'steady'\n"
      "[numerics]\norder = 12\ndt = 0.1\nend_time = 0.0\n"
      "[[vesicle]]\nname = 'left'\n"
      "[[vesicle]]\nname = 'right'\n[vesicle.shape]\ncentre = [{}, {}, {}]\nscale = 0.8\n"
      "rotation = [1.0, -0.4, 0.2, 80.0]\n"
      "[vesicle.membrane]\ncapacitance = 0.7\nconductance = 1.5\nspontaneous_curvature = -0.4\n"
      "[vesicle.fluid]\nviscosity_ratio = 3.0\n"
      "[vesicle.electric]\nconductivity_in = 5.0\npermittivity_ratio = 0.5\n",
      0.8 * distance, 0.36 * distance, 0.48 * distance);
}

CheckNumbers right_numbers(const std::string& scene) {
  FrozenState frozen = vehd::read_frozen_state({"scene.toml", {}, scene}, std::nullopt);
  frozen.source = "scene";
  // Membranes that are charging, so that their currents are not zero.
  for (vehd::VesicleState& vesicle : frozen.state.vesicles) vesicle.transmembrane_potential *= 0.6;
  CheckNumbers numbers(vehd::check_problem(frozen), 12, 18);
  numbers.store_found();
  return {vehd::check_problem(numbers.problem.frozen), 12, 18};
}

struct Damage {
  std::string name;
  std::function<void(CheckNumbers&)> apply;
  std::size_t vesicle;  ///< whose row must detect the damage
  std::string row;
};

template <typename Values>
Damage field_damage(const std::string& name, std::size_t vesicle, Values CheckFields::*field, const std::string& row,
                    double factor) {
  return {fmt::format("{} of {} x {}", name, vesicle, factor),
          [=](CheckNumbers& numbers) {
            numbers.bie[vesicle].*field *= factor;
            numbers.high[vesicle].*field *= factor;
          },
          vesicle, row};
}

Damage coefficient_damage(const std::string& name, std::size_t vesicle, const std::string& row,
                          const std::function<void(FrozenState&)>& change) {
  return {name,
          [=](CheckNumbers& numbers) {
            FrozenState wrong = numbers.problem.frozen;
            change(wrong);
            numbers.solve(wrong);
          },
          vesicle, row};
}

std::vector<Damage> all_damages() {
  constexpr double larger = 1.01;
  std::vector<Damage> damages;
  for (const std::size_t a : {0, 1}) {
    damages.push_back(field_damage("q", a, &CheckFields::charge, "fields/q", larger));
    damages.push_back(field_damage("f_E", a, &CheckFields::force_electric, "fields/force", -1.0));
    damages.push_back(field_damage("steady V_m", a, &CheckFields::steady_potential, "fields/Vm", larger));
    damages.push_back(field_damage("dV_m/dt", a, &CheckFields::potential_rate, "fields/charging_current", larger));
    damages.push_back(field_damage("v", a, &CheckFields::velocity, "fields/velocity", larger));
    damages.push_back({fmt::format("stored q of {}", a),
                       [=](CheckNumbers& n) { n.problem.frozen.fields.vesicles[a].charge *= larger; }, a, "stored/q"});
    damages.push_back(coefficient_damage(fmt::format("V_m of {}", a), a, "fields/q", [=](FrozenState& s) {
      s.state.vesicles[a].transmembrane_potential *= larger;
    }));
    damages.push_back(coefficient_damage(fmt::format("sigma_i of {}", a), a, "fields/q",
                                         [=](FrozenState& s) { s.model.vesicles[a].inside.conductivity *= 1.02; }));
    damages.push_back(coefficient_damage(fmt::format("mu_i of {}", a), a, "fields/velocity",
                                         [=](FrozenState& s) { s.model.vesicles[a].viscosity_ratio *= 1.2; }));
  }
  return damages;
}

std::string verdict_of(const nlohmann::json& vesicle, const std::string& row) {
  const std::size_t slash = row.find('/');
  return vesicle[row.substr(0, slash)][row.substr(slash + 1)]["verdict"];
}

}  // namespace

BOOST_AUTO_TEST_CASE(methods_agree_at_both_gaps) {
  for (const double distance : {3.2, 2.25}) {
    const TemporaryDirectory directory;
    write_text(directory / "scene.toml", scene_text(distance));
    const ProgramResult result = run_vehd({"check", directory / "scene.toml", "--quick", "-o", directory / "out",
                                           "--ranks", "2", "--json", directory / "result.json"});
    BOOST_TEST(result.exit_code == 0, result.output + result.errors);
    BOOST_TEST_MESSAGE(result.output << result.errors);
    const nlohmann::json json = json_of(directory / "result.json");
    BOOST_TEST_REQUIRE(json["vesicles"].size() == 2);
    for (const nlohmann::json& vesicle : json["vesicles"]) {
      for (const char* field : {"q", "Vm", "q_steady", "force", "charging_current", "velocity", "velocity_own_force"}) {
        BOOST_TEST_REQUIRE(vesicle["fields"].contains(field), field);
        BOOST_TEST(vesicle["fields"][field]["l2"].get<double>() < 0.03, field);
      }
      for (const char* field :
           {"q", "force", "force_bending", "force_bending_work", "velocity", "surface_divergence"}) {
        BOOST_TEST(vesicle["stored"].contains(field), field);
      }
    }
    BOOST_TEST(!json["vesicles"][0]["from_shape"].contains("spontaneous_curvature"));
    BOOST_TEST(json["vesicles"][1]["from_shape"]["spontaneous_curvature"]["l2"].get<double>() < 1e-4);
    for (const char* file : {"/surface.vtu", "/volume.vtu", "/differences.png"}) {
      BOOST_TEST(std::filesystem::file_size(directory / ("out" + std::string(file))) > 10000U, file);
    }
  }
}

BOOST_AUTO_TEST_CASE(whatever_is_damaged_on_either_vesicle_is_noticed) {
  const TemporaryDirectory directory;
  const CheckNumbers right = right_numbers(scene_text(3.2));
  right.write(directory / "right.h5");
  std::vector<std::string> command{
      finite_element_program().string(), "check", directory / "right.h5", "--quick", "-o", directory / "out", "--json",
      directory / "result.json"};
  const std::vector<Damage> damages = all_damages();
  for (std::size_t i = 0; i < damages.size(); ++i) {
    CheckNumbers wrong = right;
    damages[i].apply(wrong);
    const std::string file = directory / fmt::format("wrong{}.h5", i);
    wrong.write(file);
    command.insert(command.end(), {"--further", file});
  }
  const ProgramResult program = run_command(command);
  BOOST_TEST(program.exit_code == 0, program.output + program.errors);
  const nlohmann::json json = json_of(directory / "result.json");
  BOOST_TEST_REQUIRE(json["further"].size() == damages.size());
  for (std::size_t i = 0; i < damages.size(); ++i) {
    const Damage& damage = damages[i];
    const nlohmann::json& result = json["further"][i];
    BOOST_TEST(result["verdict"] == "disagree", damage.name);
    BOOST_TEST(verdict_of(result["vesicles"][damage.vesicle], damage.row) == "disagree",
               damage.name + " in " + damage.row);
  }
}

BOOST_AUTO_TEST_CASE(scenes_that_cannot_be_checked_are_refused_in_one_line) {
  const TemporaryDirectory directory;
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& message) {
    const ProgramResult result = run_vehd(arguments);
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(result.errors.find(message) != std::string::npos, result.errors);
  };
  const std::string scene = directory / "scene.toml";
  const std::string start = scene_text(3.2),
                    third = "[[vesicle]]\nname = 'third'\n[vesicle.shape]\ncentre = [0, 6, 0]\n";
  write_text(scene, start + third);
  refused({"check", scene, "--quick"}, "scene.toml: has 3 vesicles; vehd check accepts one or two");
  refused({"mesh", scene, "-o", directory / "mesh.msh"}, "scene.toml: has 3 vesicles; vehd mesh accepts one or two");
  write_text(scene, start);
  refused({"mesh", scene, "--family", "tet", "-o", directory / "mesh.msh"},
          "--family tet: meshes one vesicle; accepted for two: hex");
  refused({"check", scene, "--quick", "--set", "electric.permittivity=1", "--set", "electric.displacement_current=true",
           "--set", "electric.initial_Vm=zero"},
          "has displacement currents, which the finite-element check supports for one vesicle only");
}

BOOST_AUTO_TEST_CASE(mesh_of_two_is_written_with_its_quality) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", scene_text(2.25));
  const ProgramResult result =
      run_vehd({"mesh", directory / "scene.toml", "-o", directory / "mesh.msh", "--json", directory / "mesh.json"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  const nlohmann::json json = json_of(directory / "mesh.json");
  BOOST_TEST(json["smallest_scaled_jacobian"].get<double>() > 0.1, json.dump());
  BOOST_TEST_REQUIRE(json["vesicles"].size() == 2);
  for (const nlohmann::json& vesicle : json["vesicles"]) {
    BOOST_TEST(std::abs(vesicle["volume_error"].get<double>()) < 1e-3);
    BOOST_TEST(std::abs(vesicle["area_error"].get<double>()) < 1e-3);
  }
  BOOST_TEST(file_text(directory / "mesh.msh").find("membrane_outside_1") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
