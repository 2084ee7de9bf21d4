#include <boost/test/unit_test.hpp>
#include <functional>
#include <nlohmann/json.hpp>

#include "bie/physics/effects/gravity.hpp"
#include "bie/physics/effects/spontaneous_curvature.hpp"
#include "bie/sphere/harmonics.hpp"
#include "tests/app/check_numbers.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/program.hpp"

// The finite elements run one process on each processor.
BOOST_AUTO_TEST_SUITE(check_damage, *boost::unit_test::precondition(finite_elements_are_built) *
                                        boost::unit_test::label("slow") * boost::unit_test::label("extended") *
                                        boost::unit_test::label("once"))

namespace {

using vehd::CheckFields;
using vehd::FrozenState;
using vehd::Index;
using vehd::Matrix;
using vehd::Vector;

/// A scene with all effects and no symmetry.
std::string scene_text(const std::string& axes, const std::string& membrane, const std::string& fluid) {
  return "[shape]\nkind = 'ellipsoid'\naxes = " + axes +
         "\nrotation = [0.3, 1.0, 0.2, 35.0]\ncentre = [100.0, 0.0, 50.0]\n"
         "[membrane]\ncapacitance = 1.0\nconductance = 0.5\n" +
         membrane + "[flow]\nkind = 'shear'\nrate = 1.0\n[fluid]\n" + fluid +
         "[electric]\nfield = [0.3, 0.2, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\npermittivity_ratio = "
         "0.5\ninitial_Vm = 'steady'\n"
         "[numerics]\norder = 12\ndt = 0.1\nend_time = 0.0\n";
}

/// Changes the fields of both orders.
void change_both(CheckNumbers& numbers, const std::function<void(CheckFields&)>& change) {
  change(numbers.bie.front());
  change(numbers.high.front());
}

struct Damage {
  std::string name;
  std::function<void(CheckNumbers&)> apply;
  std::string row;  ///< "fields/q": a row that must detect the damage
};

CheckNumbers right_numbers(const std::string& scene) {
  FrozenState frozen = vehd::read_frozen_state({"scene.toml", {}, scene}, std::nullopt);
  frozen.source = "scene";
  // A membrane that is charging, so that its current is not zero.
  frozen.state.vesicles.front().transmembrane_potential *= 0.6;
  CheckNumbers numbers(vehd::check_problem(frozen), 12, 18);
  numbers.store_found();
  return {vehd::check_problem(numbers.problem.frozen), 12, 18};
}

/// Multiplies a field by the same factor at both orders, as code with a wrong factor would.
template <typename Values>
void add_field(std::vector<Damage>& damages, const std::string& name, Values CheckFields::*field,
               const std::string& row, const std::vector<double>& factors) {
  for (const double factor : factors) {
    damages.push_back(
        {name + " x " + std::to_string(factor),
         [=](CheckNumbers& numbers) { change_both(numbers, [&](CheckFields& f) { f.*field *= factor; }); }, row});
  }
}

template <typename Values>
void add_stored(std::vector<Damage>& damages, const std::string& name, Values vehd::VesicleFields::*field,
                const std::vector<double>& factors) {
  for (const double factor : factors) {
    damages.push_back({"stored " + name + " x " + std::to_string(factor),
                       [=](CheckNumbers& n) { n.problem.frozen.fields.vesicles.front().*field *= factor; },
                       "stored/" + name});
  }
}

void add_coefficient(std::vector<Damage>& damages, const std::string& name, const std::string& row,
                     const std::function<void(FrozenState&)>& change) {
  damages.push_back({name,
                     [=](CheckNumbers& numbers) {
                       FrozenState wrong = numbers.problem.frozen;
                       change(wrong);
                       numbers.solve(wrong);
                     },
                     row});
}

/// Multiplies the values of both orders at the sample points of one location by a factor.
void add_samples(std::vector<Damage>& damages, const std::string& place, double electric, double flow) {
  const auto add = [&](const std::string& field, const auto& scale) {
    damages.push_back({field + " " + place,
                       [=](CheckNumbers& n) {
                         for (Index i = 0; i < n.problem.samples.points.rows(); ++i) {
                           const bool near = n.problem.samples.distance[i] > 0.0;
                           const bool inside = n.bie.front().is_inside[static_cast<std::size_t>(i)];
                           if (near ? place == "near" : place == (inside ? "inside" : "outside")) {
                             change_both(n, [&](CheckFields& f) { scale(f, i); });
                           }
                         }
                       },
                       "fields/" + field + "_" + place});
  };
  add("potential", [=](CheckFields& f, Index i) { f.sample_potential[i] *= electric; });
  add("velocity", [=](CheckFields& f, Index i) { f.sample_velocity.row(i) *= flow; });
}

/// Multiplies weight and spontaneous curvature by factors.
void scale_effects(FrozenState& state, double weight, double curvature) {
  for (auto& effect : state.model.vesicles.front().effects) {
    if (const auto* gravity = dynamic_cast<const vehd::GravityEffect*>(effect.get())) {
      vehd::GravityParameters parameters = gravity->parameters();
      parameters.density_difference *= weight;
      effect = std::make_shared<vehd::GravityEffect>(parameters);
    } else if (const auto* bending = dynamic_cast<const vehd::SpontaneousCurvatureEffect*>(effect.get())) {
      vehd::SpontaneousCurvatureParameters parameters = bending->parameters();
      parameters.curvature *= curvature;
      effect = std::make_shared<vehd::SpontaneousCurvatureEffect>(parameters);
    }
  }
}

/// Relative sizes of the damages.
struct Sizes {
  double flow;         ///< of the flow, and of coefficients
  double electric;     ///< of the electric fields, which coarse elements compute with one digit more
  double conductance;  ///< of G_m
  double weight;
  double inner_viscosity;  ///< of μ_i, on which v hardly depends
};

std::vector<Damage> all_damages(const Sizes& sizes) {
  const double small = sizes.flow, larger = 1.0 + small;
  const std::vector<double> factors{larger, -1.0, 0.5}, electric{1.0 + sizes.electric, -1.0, 0.5};
  std::vector<Damage> damages;
  add_field(damages, "q", &CheckFields::charge, "fields/q", electric);
  add_field(damages, "f_E", &CheckFields::force_electric, "fields/force", electric);
  add_field(damages, "steady V_m", &CheckFields::steady_potential, "fields/Vm", electric);
  add_field(damages, "steady q", &CheckFields::steady_charge, "fields/q_steady", electric);
  add_field(damages, "dV_m/dt", &CheckFields::potential_rate, "fields/charging_current", electric);
  add_field(damages, "f_b", &CheckFields::force_bending, "stored/force_bending", factors);
  add_field(damages, "f_lambda", &CheckFields::force_tension, "stored/force_tension", factors);
  add_field(damages, "v", &CheckFields::velocity, "fields/velocity", factors);
  add_field(damages, "v of own f_E", &CheckFields::velocity_own_force, "fields/velocity_own_force", factors);
  add_field(damages, "f_b from the shape", &CheckFields::force_bending, "from_shape/bending_work", factors);
  add_field(damages, "f_c from the shape", &CheckFields::force_curvature, "from_shape/spontaneous_curvature", factors);
  add_field(damages, "lambda from the shape", &CheckFields::tension, "from_shape/tension", factors);
  add_field(damages, "v from the shape", &CheckFields::velocity_of_shape, "from_shape/velocity", factors);
  for (const char* place : {"inside", "outside", "near"}) {
    for (const double factor : {1.0, -1.0, 0.5}) {
      add_samples(damages, place, factor == 1.0 ? electric.front() : factor, factor == 1.0 ? larger : factor);
    }
  }
  using Stored = vehd::VesicleFields;
  add_stored(damages, "q", &Stored::charge, electric);
  add_stored(damages, "force", &Stored::force_electric, electric);
  add_stored(damages, "force_bending", &Stored::force_bending, factors);
  add_stored(damages, "force_tension", &Stored::force_tension, factors);
  add_stored(damages, "tension", &Stored::tension, factors);
  add_stored(damages, "velocity", &Stored::velocity, factors);
  damages.push_back({"stored v that stretches",
                     [=](CheckNumbers& n) {
                       Stored& stored = n.problem.frozen.fields.vesicles.front();
                       Matrix swelling = n.problem.frozen.state.vesicles.front().position;
                       swelling.row(0).setZero();
                       stored.velocity += small * swelling * stored.velocity.norm() / swelling.norm();
                     },
                     "stored/surface_divergence"});
  // Scales only the layer; the background flow is unchanged.
  damages.push_back({"Stokes layer x 0.95",
                     [](CheckNumbers& numbers) {
                       const Matrix& x = numbers.problem.frozen.state.vesicles.front().position;
                       const Matrix background = x * vehd::flow_gradient(numbers.problem.frozen).transpose();
                       change_both(numbers, [&](CheckFields& f) {
                         f.velocity = 0.95 * f.velocity + 0.05 * vehd::resize_order(background, f.order);
                       });
                     },
                     "fields/velocity"});
  const auto random = [](CheckFields& fields) {
    const auto fill = [](auto& values) { values.setRandom(); };
    fill(fields.charge);
    fill(fields.force_electric);
    fill(fields.potential_rate);
    fill(fields.force_bending);
    fill(fields.force_curvature);
    fill(fields.force_tension);
    fill(fields.tension);
    fill(fields.velocity_of_shape);
    fill(fields.steady_potential);
    fill(fields.steady_charge);
    fill(fields.velocity);
    fill(fields.velocity_own_force);
    fill(fields.sample_potential);
    fill(fields.sample_velocity);
  };
  for (const char* row : {"fields/q", "fields/force", "fields/Vm", "fields/velocity", "stored/q", "stored/velocity",
                          "from_shape/velocity", "from_shape/tension"}) {
    damages.push_back({"order of the run random", [=](CheckNumbers& n) { random(n.bie.front()); }, row});
    damages.push_back({"other order random", [=](CheckNumbers& n) { random(n.high.front()); }, row});
  }
  // One side of the comparison has another coefficient, or interior and exterior are exchanged.
  add_coefficient(damages, "C_m x 100", "fields/charging_current",
                  [](FrozenState& s) { s.model.vesicles[0].charging.capacitance *= 100.0; });
  add_coefficient(damages, "C_m", "fields/charging_current",
                  [=](FrozenState& s) { s.model.vesicles[0].charging.capacitance *= larger; });
  add_coefficient(damages, "G_m", "fields/Vm",
                  [=](FrozenState& s) { s.model.vesicles[0].charging.conductance *= 1.0 + sizes.conductance; });
  add_coefficient(damages, "sigma_i", "fields/q",
                  [=](FrozenState& s) { s.model.vesicles[0].inside.conductivity *= larger; });
  add_coefficient(damages, "sigma_e", "fields/q", [=](FrozenState& s) { s.model.electric->conductivity *= larger; });
  add_coefficient(damages, "wrong side of q", "fields/q", [](FrozenState& s) {
    std::swap(s.model.vesicles[0].inside.conductivity, s.model.electric->conductivity);
  });
  add_coefficient(damages, "epsilon", "fields/force",
                  [=](FrozenState& s) { s.model.electric->permittivity *= larger; });
  add_coefficient(damages, "epsilon_i", "fields/force",
                  [=](FrozenState& s) { s.model.vesicles[0].inside.permittivity_ratio *= larger; });
  add_coefficient(damages, "wrong side of f_E", "fields/force", [](FrozenState& s) {
    s.model.electric->permittivity *= s.model.vesicles[0].inside.permittivity_ratio;
    s.model.vesicles[0].inside.permittivity_ratio = 1.0 / s.model.vesicles[0].inside.permittivity_ratio;
  });
  add_coefficient(damages, "E", "fields/q", [=](FrozenState& s) { s.model.electric->field *= larger; });
  add_coefficient(damages, "V_m", "fields/q",
                  [=](FrozenState& s) { s.state.vesicles[0].transmembrane_potential *= 1.0 + sizes.electric; });
  add_coefficient(damages, "wrong side of V_m", "fields/q",
                  [](FrozenState& s) { s.state.vesicles[0].transmembrane_potential *= -1.0; });
  add_coefficient(damages, "mu", "fields/velocity", [=](FrozenState& s) { s.model.viscosity *= larger; });
  add_coefficient(damages, "mu_i", "fields/velocity",
                  [=](FrozenState& s) { s.model.vesicles[0].viscosity_ratio *= 1.0 + sizes.inner_viscosity; });
  add_coefficient(damages, "rate of the flow", "fields/velocity",
                  [=](FrozenState& s) { s.model.flow->gradient *= larger; });
  add_coefficient(damages, "kappa_B", "stored/force_bending",
                  [=](FrozenState& s) { s.model.vesicles[0].bending->modulus *= larger; });
  add_coefficient(damages, "kappa_B of the shape's force", "from_shape/bending_work",
                  [=](FrozenState& s) { s.model.vesicles[0].bending->modulus *= larger; });
  add_coefficient(damages, "weight", "from_shape/velocity",
                  [=](FrozenState& s) { scale_effects(s, 1.0 + sizes.weight, 1.0); });
  add_coefficient(damages, "spontaneous curvature", "from_shape/spontaneous_curvature",
                  [=](FrozenState& s) { scale_effects(s, 1.0, larger); });
  add_coefficient(damages, "mu of the shape's flow", "from_shape/velocity",
                  [=](FrozenState& s) { s.model.viscosity *= larger; });
  return damages;
}

std::string verdict_of(const nlohmann::json& result, const std::string& row) {
  const std::size_t slash = row.find('/');
  return result[row.substr(0, slash)][row.substr(slash + 1)]["verdict"];
}

/// Runs the finite elements once and requires that they notice all damages.
/// @param arguments  passed to the finite elements
void require_noticed(const CheckNumbers& right, const std::vector<Damage>& damages,
                     const std::vector<std::string>& arguments) {
  const TemporaryDirectory directory;
  const auto write = [&](const std::string& name, const CheckNumbers& n) {
    n.write(directory / name);
    return directory / name;
  };
  std::vector<std::string> command{
      finite_element_program().string(), "check", write("right.h5", right), "-o", directory / "out", "--json",
      directory / "result.json"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  for (std::size_t i = 0; i < damages.size(); ++i) {
    CheckNumbers wrong = right;
    damages[i].apply(wrong);
    command.insert(command.end(), {"--further", write("wrong" + std::to_string(i) + ".h5", wrong)});
  }
  const ProgramResult program = run_command(command);
  BOOST_TEST(program.exit_code == 0, program.output + program.errors);
  BOOST_TEST_MESSAGE(program.output + program.errors);
  const nlohmann::json json = json_of(directory / "result.json");
  BOOST_TEST_REQUIRE(json["further"].size() == damages.size());
  for (std::size_t i = 0; i < damages.size(); ++i) {
    const nlohmann::json& result = json["further"][i];
    BOOST_TEST(result["verdict"] != "agree", damages[i].name);
    BOOST_TEST(verdict_of(result, damages[i].row) != "agree", damages[i].name + " in " + damages[i].row);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(whatever_is_damaged_is_noticed) {
  const CheckNumbers right =
      right_numbers(scene_text("[1.0, 1.15, 1.3]", "bending_modulus = 0.1\nspontaneous_curvature = -0.4\n",
                               "density_difference = 0.5\n[gravity]\nacceleration = [0.2, 0.5, -0.8]\n"));
  require_noticed(right, all_damages({1e-2, 2e-3, 5e-2, -1.0, 5e-2}), {"--quick"});
}

// A check with its default elements, on a shape that a low degree resolves.
BOOST_AUTO_TEST_CASE(a_thousandth_is_noticed_without_haste) {
  const CheckNumbers right = right_numbers(
      scene_text("[1.0, 1.1, 1.2]", "bending_modulus = 3.0\nspontaneous_curvature = -1.5\n",
                 "viscosity_ratio = 3.0\ndensity_difference = 1.5\n[gravity]\nacceleration = [0.2, 0.5, -0.8]\n"));
  require_noticed(right, all_damages({1e-3, 1e-3, 1e-3, 1e-3, 1e-3}), {});
}

BOOST_AUTO_TEST_SUITE_END()
