#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <functional>
#include <nlohmann/json.hpp>

#include "bie/comparison/check_input.hpp"
#include "bie/files/hdf5_reader.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/reference_run.hpp"

// The finite elements are one process for each processor.
BOOST_AUTO_TEST_SUITE(check_verdicts, *boost::unit_test::precondition(finite_elements_are_built) *
                                          boost::unit_test::label("slow") * boost::unit_test::label("extended") *
                                          boost::unit_test::label("once"))

namespace {

struct Check {
  int exit_code;
  std::string text;
  nlohmann::json json;
};

/// A quick check by one rank.
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

// Solved anew in the degree of the file, the highest that the run may take, f_b, q, f_E and lambda were all said to be
// wrong.
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

// What remains of terms that cancel, and numbers of the size of rounding.
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

// f_b as a field is not resolved at its degree; its work is.
BOOST_AUTO_TEST_CASE(first_command_of_the_page_agrees) {
  const Check check = checked(VEHD_SOURCE_DIR "/docs/scenes/figure2.toml");
  BOOST_TEST(check.exit_code == 0, check.text);
  BOOST_TEST(check.json["stored"]["force_bending_work"]["judged_by"] == "elements");
  BOOST_TEST(check.json["stored"]["force_bending"]["judged_by"] == "boundary integrals");
  BOOST_TEST(check.text.find("\nverdict: the two methods agree\n") != std::string::npos, check.text);
}

namespace {

using vehd::FrozenState;
using Stored = vehd::VesicleFields;

/// A number of a snapshot and the share of it that docs/check.md says is noticed.
struct Number {
  std::string name;
  double noticed;
  /// The numbers of the snapshot if this one is wrong by a share.
  std::function<Stored(const FrozenState& right, double share)> wrong;
};

template <typename Values>
Number scaled(const std::string& name, double noticed, Values Stored::*field) {
  return {name, noticed, [=](const FrozenState& right, double share) {
            Stored stored = right.fields.vesicles.front();
            stored.*field *= 1.0 + share;
            return stored;
          }};
}

/// Fields of another state, which does not belong to them then.
Number of_state(const std::string& name, double noticed,
                const std::function<void(vehd::VesicleState&, double)>& change) {
  return {name, noticed, [=](const FrozenState& right, double share) {
            FrozenState other = right;
            change(other.state.vesicles.front(), share);
            const vehd::CheckFields of = vehd::check_fields(other, vehd::check_contents(other),
                                                            vehd::Matrix::Zero(169, 3), 12, vehd::Matrix(0, 3));
            Stored stored = right.fields.vesicles.front();
            stored.charge = of.charge;
            stored.force_electric = of.force_electric;
            stored.force_bending = of.force_bending;
            stored.force_tension = of.force_tension;
            stored.tension = of.tension;
            stored.velocity = of.velocity_of_shape;
            return stored;
          }};
}

}  // namespace

// The table of docs/check.md. A bending force that was wrong by a percent passed at this modulus.
BOOST_AUTO_TEST_CASE(damage_of_the_size_that_the_page_says_is_noticed) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml",
             "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.15, 1.3]\nrotation = [0.3, 1.0, 0.2, 35.0]\n"
             "[membrane]\nbending_modulus = 0.02\nconductance = 0.5\n[flow]\nkind = 'shear'\nrate = 1.0\n"
             "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
             "initial_Vm = 'steady'\n[numerics]\norder = 12\ndt = 0.1\nend_time = 0.0\n");
  const FrozenState right = vehd::read_frozen_state({directory / "scene.toml", {}}, std::nullopt);
  const vehd::CheckContents contents = vehd::check_contents(right);
  const vehd::Matrix force = vehd::total_force(right, right.fields.vesicles.front());
  const vehd::CheckSamples samples{vehd::Matrix(0, 3), vehd::Vector(0), 0.0};
  const auto fields = [&](int order) { return vehd::check_fields(right, contents, force, order, samples.points); };
  const vehd::CheckFields bie = fields(12), high = fields(18);
  const auto write = [&](const std::string& name, const FrozenState& frozen) {
    vehd::write_check_input(directory / name, {frozen, contents, force, samples, bie, high});
    return directory / name;
  };
  const std::vector<Number> numbers{
      of_state("x", 1e-2, [](vehd::VesicleState& state, double share) { state.position *= 1.0 + share; }),
      of_state("Vm", 1e-2,
               [](vehd::VesicleState& state, double share) { state.transmembrane_potential *= 1.0 + share; }),
      scaled("q", 1e-2, &Stored::charge),
      scaled("force_electric", 1e-2, &Stored::force_electric),
      scaled("force_bending", 1e-2, &Stored::force_bending),
      scaled("force_tension", 1e-2, &Stored::force_tension),
      scaled("tension", 1e-2, &Stored::tension),
      scaled("velocity", 1e-2, &Stored::velocity)};
  std::vector<std::string> command{finite_element_program().string(),
                                   "check",
                                   write("right.h5", right),
                                   "--quick",
                                   "-o",
                                   directory / "out",
                                   "--json",
                                   directory / "result.json"};
  // Also smaller ones, which the message of each number tells of.
  const std::vector<double> shares{1.0, 0.3, 0.1, 0.03, 0.01, 0.003};
  for (const Number& number : numbers) {
    for (const double share : shares) {
      FrozenState wrong = right;
      wrong.fields.vesicles.front() = number.wrong(right, share * number.noticed);
      command.insert(command.end(), {"--further", write(number.name + std::to_string(share) + ".h5", wrong)});
    }
  }
  const ProgramResult program = run_command(command);
  BOOST_TEST_REQUIRE(program.exit_code == 0, program.output + program.errors);
  const nlohmann::json json = json_of(directory / "result.json");
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::string message = numbers[i].name + " wrong by";
    for (std::size_t j = 0; j < shares.size(); ++j) {
      const nlohmann::json& result = json["further"][i * shares.size() + j];
      message += fmt::format(" {:.0e}: {}{}", shares[j] * numbers[i].noticed, result["verdict"].get<std::string>(),
                             j + 1 < shares.size() ? "," : "");
      if (j == 0) BOOST_TEST(result["verdict"] == "disagree", numbers[i].name);
    }
    BOOST_TEST_MESSAGE(message);
  }
}

BOOST_AUTO_TEST_SUITE_END()
