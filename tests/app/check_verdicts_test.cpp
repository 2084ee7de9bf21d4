#include <fmt/format.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "bie/comparison/check.hpp"
#include "bie/files/hdf5_reader.hpp"
#include "bie/files/run_reader.hpp"
#include "bie/sphere/harmonics.hpp"
#include "tests/app/check_numbers.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/reference_run.hpp"

// The finite elements run one process on each processor.
BOOST_AUTO_TEST_SUITE(check_verdicts, *boost::unit_test::precondition(finite_elements_are_built) *
                                          boost::unit_test::label("slow") * boost::unit_test::label("extended") *
                                          boost::unit_test::label("once"))

namespace {

struct Check {
  int exit_code;
  std::string text;
  nlohmann::json json;
};

/// Runs a quick check on one rank.
Check checked(const std::string& file) {
  const TemporaryDirectory directory;
  const ProgramResult result = run_vehd({"check", file, "--quick", "--ranks", "1", "--no-plot", "-o", directory / "out",
                                         "--json", directory / "result.json"});
  BOOST_TEST_REQUIRE((result.exit_code == 0 || result.exit_code == 4), result.errors);
  return {result.exit_code, result.output + result.errors, json_of(directory / "result.json")};
}

Check checked_scene(const std::string& text) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", text);
  return checked(directory / "scene.toml");
}

const std::string ellipsoid = "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.1, 1.3]\n";
const std::string numerics = "[numerics]\ndegree = 10\ndt = 0.1\nend_time = 0.0\n";

}  // namespace

// Regression: recomputed in the degree of the file, the highest that the run may choose, f_b, q, f_E and lambda were
// all reported as wrong.
BOOST_AUTO_TEST_CASE(run_with_a_tolerance_is_judged_in_its_degree) {
  const FinishedRun run(
      "[shape]\nkind = 'ellipsoid'\naxes = [1.4, 1.0, 1.0]\n[membrane]\nbending_modulus = 0.1\nconductance = 5.0\n"
      "[flow]\nkind = 'shear'\nrate = 1.0\n"
      "[electric]\nfield = [0.0, 0.0, 1.0]\nconductivity_in = 2.0\nconductivity_out = 1.0\n"
      "[numerics]\ntolerance = 1e-2\nend_time = 0.2\n");
  const std::string file = run.output + "/run.h5";
  const Check check = checked(file);
  BOOST_TEST(check.json["order"].get<int>() < vehd::Hdf5Reader(file).integer_attribute("/", "order"));
  BOOST_TEST(check.exit_code == 0, check.text);
}

// Remainders of terms that cancel, and numbers of the size of rounding errors.
BOOST_AUTO_TEST_CASE(fields_that_vanish_agree) {
  const std::string rotation =
      "[flow]\nkind = 'gradient'\ngradient = [[0.0, 1.0, 0.3], [-1.0, 0.0, 0.2], [-0.3, -0.2, 0.0]]\n";
  const std::string insulating =
      "[membrane]\nmobile = false\ncapacitance = 1.0\n[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\n"
      "conductivity_out = 2.0\ninitial_Vm = 'steady'\n";
  for (const std::string& scene :
       {ellipsoid + rotation, ellipsoid + insulating,
        std::string("[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.0, 1.0]\n[membrane]\nbending_modulus = 1.0\n"
                    "inextensible = false\n")}) {
    const Check check = checked_scene(scene + numerics);
    BOOST_TEST(check.exit_code == 0, scene << check.text);
  }
}

// Regression: q of the steady V_m disagreed from G_m R/σ = 1e8 on, which magnifies the tolerance of the elements'
// solver.
BOOST_AUTO_TEST_CASE(steady_charges_of_a_leaky_membrane_do_not_disagree) {
  for (const char* conductance : {"1e6", "1e8", "1e10"}) {
    const Check check = checked_scene(ellipsoid + "[membrane]\nmobile = false\nconductance = " + conductance +
                                      "\n[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\n"
                                      "conductivity_out = 2.0\n" +
                                      numerics);
    const nlohmann::json row = check.json["fields"]["q_steady"];
    const bool is_magnified = std::string(conductance) != "1e6";
    BOOST_TEST(row["verdict"] == (is_magnified ? "undecided" : "agree"), conductance << check.text);
    BOOST_TEST((row["fem_error"] > check.json["required"]) == is_magnified, conductance << check.text);
    BOOST_TEST(check.json["verdict"] != "disagree", conductance << check.text);
  }
}

// f_b as a field is not resolved at its degree; its work is.
BOOST_AUTO_TEST_CASE(first_command_of_the_page_agrees) {
  const Check check = checked(VEHD_SOURCE_DIR "/docs/scenes/figure2.toml");
  BOOST_TEST(check.exit_code == 0, check.text);
  BOOST_TEST(check.json["stored"]["force_bending_work"]["judged_by"] == "elements");
  BOOST_TEST(check.json["stored"]["force_bending"]["judged_by"] == "boundary integrals");
  BOOST_TEST(check.text.find("\nverdict: the two methods agree\n") != std::string::npos, check.text);
  const Check shape33 = checked(VEHD_SOURCE_DIR "/docs/checks/shape33.toml");
  BOOST_TEST(shape33.exit_code == 0, shape33.text);
}

namespace {

using vehd::CheckFields;
using vehd::FrozenState;
using vehd::Matrix;

/// The last snapshot of a run with the boundary-integral fields for it.
CheckNumbers numbers_of_run(const std::string& scene) {
  const FinishedRun run(scene);
  vehd::CheckProblem problem = vehd::check_problem(vehd::read_frozen_state({run.output + "/run.h5", {}}, std::nullopt));
  problem.samples = {};
  const int order = vehd::order_of(problem.frozen.state.vesicles.front().position.rows());
  return {problem, order, vehd::estimate_order(order, true)};
}

/// A dataset of a snapshot whose numbers are given a relative error.
struct Number {
  std::string dataset;
  std::string row;  ///< "stored/q": row that detects it; empty: none does, however large the share
  std::function<void(CheckNumbers&, double share)> make_wrong;
};

template <typename Values>
Number stored(const std::string& dataset, const std::string& row, Values vehd::VesicleFields::*field) {
  return {dataset, row, [=](CheckNumbers& snapshot, double share) {
            snapshot.problem.frozen.fields.vesicles.front().*field *= 1.0 + share;
          }};
}

/// A dataset that determines others: the elements are given the right one, the others are computed from the wrong one.
Number decisive(const std::string& dataset, const std::string& row,
                const std::function<void(vehd::VesicleState&, double)>& change) {
  return {dataset, row, [=](CheckNumbers& snapshot, double share) {
            FrozenState other = snapshot.problem.frozen;
            change(other.state.vesicles.front(), share);
            const CheckFields of = snapshot.solved(other, snapshot.order).front();
            vehd::VesicleFields& fields = snapshot.problem.frozen.fields.vesicles.front();
            fields.charge = of.charge;
            fields.force_electric = of.force_electric;
            fields.force_bending = of.force_bending;
            fields.force_tension = of.force_tension;
            fields.tension = of.tension;
            fields.velocity = of.velocity_of_shape;
            fields.potential = of.potential_of_charges;
          }};
}

/// A dataset that determines no other stored numbers.
Number given(const std::string& dataset, const std::string& row,
             const std::function<void(vehd::VesicleState&, double)>& change) {
  return {dataset, row, [=](CheckNumbers& snapshot, double share) {
            change(snapshot.problem.frozen.state.vesicles.front(), share);
            snapshot.solve(snapshot.problem.frozen);
          }};
}

/// The elements are given the right force; the stored velocities are those computed from the wrong one.
void make_contact_wrong(CheckNumbers& snapshot, double share) {
  FrozenState other = snapshot.problem.frozen;
  for (vehd::VesicleFields& fields : other.fields.vesicles) fields.force_contact *= 1.0 + share;
  const std::vector<CheckFields> of = vehd::check_fields(vehd::check_problem(other), {snapshot.order, snapshot.order});
  for (std::size_t a = 0; a < of.size(); ++a) {
    snapshot.problem.frozen.fields.vesicles[a].velocity += of[a].velocity - snapshot.bie[a].velocity;
  }
}

bool is_noticed(const nlohmann::json& result, const Number& number) {
  if (number.row.empty()) return result["verdict"] == "disagree";
  const nlohmann::json::json_pointer row("/" + number.row + "/verdict");
  const nlohmann::json vesicles = result.contains("vesicles") ? result["vesicles"] : nlohmann::json::array({result});
  return std::ranges::any_of(vesicles, [&](const nlohmann::json& vesicle) { return vesicle[row] == "disagree"; });
}

/// Shares from the table in docs/check.md, by dataset; 0 if the table has no number.
/// @param column  of the shape in the table
std::map<std::string, double> shares_of_page(std::size_t column) {
  std::map<std::string, double> shares;
  std::istringstream page(file_text(VEHD_SOURCE_DIR "/docs/check.md"));
  std::string line;
  while (std::getline(page, line) && !line.starts_with("| dataset |")) {
  }
  const std::regex row(R"(\| (.+?) \| (.+?) \| (.+?) \| .+ \|)"), dataset("`(\\w+)`");
  while (std::getline(page, line) && line.starts_with("|")) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    const std::string names = cells[1], share = cells[1 + column];
    for (std::sregex_iterator name(names.begin(), names.end(), dataset); name != std::sregex_iterator(); ++name) {
      shares.emplace((*name)[1], share.ends_with(" %") ? std::stod(share) / 100.0 : 0.0);
    }
  }
  return shares;
}

/// Makes each number too large and too small by decreasing shares; those of the page must be noticed.
void require_noticed(const std::string& scene, const std::vector<Number>& numbers, std::size_t column = 1) {
  const std::map<std::string, double> of_page = shares_of_page(column);
  const std::vector<double> shares{0.5,  0.2,  0.1,  0.05, 0.02, 0.01, 5e-3, 2e-3,
                                   1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5};
  const TemporaryDirectory directory;
  const CheckNumbers right = numbers_of_run(scene);
  right.write(directory / "right.h5");
  std::vector<std::string> command{
      finite_element_program().string(), "check", directory / "right.h5", "--quick", "-o", directory / "out", "--json",
      directory / "result.json"};
  for (const Number& number : numbers) {
    for (const double share : shares) {
      for (const double sign : {1.0, -1.0}) {
        CheckNumbers wrong = right;
        number.make_wrong(wrong, sign * share);
        const std::string file = directory / fmt::format("{}_{}.h5", number.dataset, sign * share);
        wrong.write(file);
        command.insert(command.end(), {"--further", file});
      }
    }
  }
  const ProgramResult program = run_command(command);
  BOOST_TEST_REQUIRE(program.exit_code == 0, program.output + program.errors);
  const nlohmann::json json = json_of(directory / "result.json");
  BOOST_TEST(json["verdict"] != "disagree", program.output);
  auto result = json["further"].begin();
  for (const Number& number : numbers) {
    double least = std::numeric_limits<double>::infinity();
    bool noticed = true;
    for (const double share : shares) {
      const nlohmann::json &larger = *result++, &smaller = *result++;
      noticed = noticed && is_noticed(larger, number) && is_noticed(smaller, number);
      if (noticed) least = share;
    }
    const std::string message = fmt::format("{} is noticed from {} on by {}", number.dataset, least, number.row);
    BOOST_TEST_MESSAGE(message);
    if (number.row.empty()) {
      BOOST_TEST(std::isinf(least), message);
    } else {
      BOOST_TEST(least <= 1.001 * of_page.at(number.dataset), message);
    }
  }
}

const std::string tilted = "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.15, 1.3]\nrotation = [0.3, 1.0, 0.2, 35.0]\n",
                  oblique_field =
                      "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\n",
                  two_steps = "[numerics]\norder = 10\ntime_order = 2\ndt = 0.1\nend_time = 0.2\n";

}  // namespace

BOOST_AUTO_TEST_CASE(table_of_the_page_has_every_dataset) {
  const std::map<std::string, double> of_page = shares_of_page(1);
  for (const vehd::SnapshotField& field : vehd::snapshot_fields()) BOOST_TEST(of_page.contains(field.name), field.name);
}

// Regression: a bending force that was wrong by one per cent passed at this modulus.
BOOST_AUTO_TEST_CASE(damage_of_the_size_that_the_page_says_is_noticed) {
  using Stored = vehd::VesicleFields;
  const std::vector<Number> numbers{
      decisive("x", "stored/force_bending_work",
               [](vehd::VesicleState& state, double share) { state.position *= 1.0 + share; }),
      decisive("Vm", "stored/q",
               [](vehd::VesicleState& state, double share) { state.transmembrane_potential *= 1.0 + share; }),
      stored("q", "stored/q", &Stored::charge),
      stored("force_electric", "stored/force", &Stored::force_electric),
      stored("force_bending", "stored/force_bending_work", &Stored::force_bending),
      stored("force_tension", "stored/force_tension_work", &Stored::force_tension),
      stored("tension", "stored/tension", &Stored::tension),
      stored("velocity", "stored/velocity", &Stored::velocity)};
  const std::string physics =
      "[membrane]\nbending_modulus = 0.02\nconductance = 0.5\n[flow]\nkind = 'shear'\nrate = 1.0\n" + oblique_field +
      "initial_Vm = 'steady'\n[numerics]\ndt = 0.1\nend_time = 0.0\n";
  require_noticed(tilted + physics + "order = 12\n", numbers, 1);
  require_noticed(
      "[shape]\nkind = 'radial'\nbase = 1.0\namplitude = 0.2\nexponent = -3.0\nmodes = [{n = 3, m = 2, a = 1.0}]\n" +
          physics + "order = 24\n",
      numbers, 2);
}

BOOST_AUTO_TEST_CASE(damage_of_free_charges_is_noticed) {
  require_noticed(tilted + "[membrane]\nmobile = false\ncapacitance = 1.0\nconductance = 0.5\n" + oblique_field +
                      "permittivity = 0.3\npermittivity_ratio = 0.8\ndisplacement_current = true\n" + two_steps,
                  {decisive("free_charge_in", "stored/q",
                            [](vehd::VesicleState& state, double share) {
                              state.free_charge += share * state.transmembrane_potential;
                              state.transmembrane_potential *= 1.0 + share;
                            }),
                   decisive("free_charge_out", "stored/q", [](vehd::VesicleState& state, double share) {
                     state.free_charge += share * (state.free_charge - state.transmembrane_potential);
                   })});
}

// Both methods take spatially varying C_m, G_m and J_p from the snapshot. For pores the boundary integrals take the
// state of the pores, the elements G_m.
BOOST_AUTO_TEST_CASE(damage_of_pores_is_noticed_and_that_of_varying_properties_is_not) {
  const std::string membrane =
      tilted +
      "[membrane]\nmobile = false\ncapacitance = 0.5\nconductance = 0.3\n"
      "[membrane.varying_capacitance]\nkind = 'harmonics'\nmodes = [{n = 1, m = 1, a = 0.3}]\n"
      "[membrane.pump]\ncurrent = 0.4\nkind = 'harmonics'\nmodes = [{n = 1, m = -1, a = 1.0}, {n = 2, m = 0, a = "
      "0.5}]\n";
  require_noticed(
      membrane + oblique_field +
          "permittivity = 0.3\n[poration]\nmodel = 'pores'\ncreation_rate = 1.0\ncreation_Vm = 0.5\nrest_density = "
          "2.0\npore_radius = 0.1\nmembrane_thickness = 0.2\n" +
          two_steps,
      {given("poration", "fields/charging_current",
             [](vehd::VesicleState& state, double share) { state.poration *= 1.0 + share; }),
       stored("conductance", "fields/charging_current", &vehd::VesicleFields::conductance),
       given("capacitance", "",
             [](vehd::VesicleState& state, double share) { state.material.capacitance *= 1.0 + share; }),
       given("pump_current", "",
             [](vehd::VesicleState& state, double share) { state.material.pump_current *= 1.0 + share; })});
  require_noticed(membrane + "[membrane.varying_conductance]\nkind = 'harmonics'\nmodes = [{n = 1, m = 0, a = 0.5}]\n" +
                      oblique_field + two_steps,
                  {given("conductance", "",
                         [](vehd::VesicleState& state, double share) { state.material.conductance *= 1.0 + share; })});
}

BOOST_AUTO_TEST_CASE(damage_of_contact_forces_is_noticed) {
  require_noticed(tilted +
                      "[membrane]\nbending_modulus = 0.02\n[contact]\nenergy = 0.1\nrange = 0.6\n"
                      "[numerics]\norder = 12\ndt = 0.1\nend_time = 0.0\n[[vesicle]]\nname = 'left'\n"
                      "[[vesicle]]\nname = 'right'\n[vesicle.shape]\ncentre = [2.0, 0.9, 1.2]\n"
                      "rotation = [1.0, -0.4, 0.2, 80.0]\n",
                  {{"force_contact", "stored/velocity", make_contact_wrong}});
}

BOOST_AUTO_TEST_SUITE_END()
