#include <boost/test/unit_test.hpp>
#include <cmath>
#include <optional>

#include "bie/stepping/evolution.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr double kDt = 0.05;

EvolutionSetup setup_of(const Model& model, const Matrix& position) {
  EvolutionSetup setup;
  setup.model = model;
  setup.settings.order = order_of(position.rows());
  setup.control = fixed_steps(kDt);
  return setup;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(jump)

BOOST_AUTO_TEST_CASE(both_sides_of_a_switch_are_those_of_the_forcing_that_holds_there) {
  // Just before the end of a pulse the fields are those of a constant field, just after it those without a field.
  const Matrix position = prolate(10);
  Model pulse = field_model(), constant = field_model(), off = field_model();
  pulse.electric->waveform = Waveform::pulse(1.0, 0.0, 4 * kDt);
  off.electric->waveform = Waveform::pulse(1.0, 50.0, 1.0);
  Instruments instruments;
  Evolution evolution(setup_of(pulse, position), {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  BOOST_TEST(!evolution.before_jump().has_value());
  const EventTimes events{{}, 1.0};
  for (int i = 0; i < 3; ++i) {
    evolution.step(events);
    BOOST_TEST(!evolution.before_jump().has_value());
  }
  evolution.step(events);
  BOOST_TEST_REQUIRE(evolution.before_jump().has_value());
  const auto of_one = [](const Evaluation& e) {
    return Evaluated{e.fields.vesicles[0], e.diagnostics.vesicles[0], {}};
  };
  const Evaluated before = of_one(*evolution.before_jump());
  const Evaluated after = of_one(evolution.evaluation());
  const Discretisation discretisation(setup_of(pulse, position).settings);
  const Evaluated held = evaluated(constant, discretisation, evolution.state());
  const Evaluated free = evaluated(off, discretisation, evolution.state());
  for (const auto& [side, like] : {std::pair{&before, &held}, std::pair{&after, &free}}) {
    BOOST_TEST(max_difference(side->fields.charge, like->fields.charge) < 1e-8);
    BOOST_TEST(max_difference(side->fields.force_electric, like->fields.force_electric) < 1e-8);
    BOOST_TEST(max_difference(side->fields.velocity, like->fields.velocity) < 1e-8);
    BOOST_TEST(std::abs(side->diagnostics.tension_integral - like->diagnostics.tension_integral) < 1e-7);
  }
  BOOST_TEST(std::abs(before.diagnostics.q_north - after.diagnostics.q_north) > 0.1);
  BOOST_TEST(before.diagnostics.area == after.diagnostics.area);
  BOOST_TEST(before.diagnostics.Vm_north == after.diagnostics.Vm_north);
  evolution.step(events);
  BOOST_TEST(!evolution.before_jump().has_value());
}

BOOST_AUTO_TEST_CASE(discontinuity_of_the_slope_alone_has_one_side) {
  const Matrix position = prolate(8);
  Model model = field_model();
  model.electric->waveform = Waveform::table({0.0, 0.1, 0.3}, {0.0, 1.0, 0.3});
  Instruments instruments;
  Evolution evolution(setup_of(model, position), {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  while (evolution.state().time < 0.3) {
    evolution.step({{}, 0.3});
    BOOST_TEST(!evolution.before_jump().has_value());
  }
}

BOOST_AUTO_TEST_CASE(flow_that_is_switched_has_two_sides_as_well) {
  const Matrix position = prolate(8);
  Model model = shear_model();
  model.flow->waveform = Waveform::table({0.0, 0.1, 0.1, 0.2}, {1.0, 1.0, -2.0, -2.0});
  Instruments instruments;
  Evolution evolution(setup_of(model, position), {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  evolution.step({{}, 0.2});
  BOOST_TEST(!evolution.before_jump().has_value());
  evolution.step({{}, 0.2});
  BOOST_TEST_REQUIRE(evolution.before_jump().has_value());
  const Matrix& velocity = evolution.evaluation().fields.vesicles[0].velocity;
  const Matrix& before = evolution.before_jump()->fields.vesicles[0].velocity;
  BOOST_TEST((velocity - before).norm() > 0.5 * before.norm());
}

BOOST_AUTO_TEST_CASE(no_extrapolation_crosses_a_jump) {
  const Matrix position = prolate(10);
  Model model = field_model();
  model.electric->waveform = Waveform::pulse(1.0, 0.0, 0.3);
  EvolutionSetup setup = setup_of(model, position);
  setup.settings.time_order = 5;
  setup.control = {1.0, 1e-9, 1e-2};
  Instruments instruments;
  Evolution evolution(setup, {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  int n_jumps = 0;
  while (evolution.state().time < 0.5) {
    evolution.step({{}, 0.5});
    const bool has_jumped = evolution.before_jump().has_value();
    n_jumps += has_jumped ? 1 : 0;
    BOOST_TEST(evolution.state().past_times.size() == (has_jumped ? 0 : 3));
    BOOST_TEST((evolution.state().vesicles[0].past.size() == 0) == has_jumped);
  }
  BOOST_TEST(n_jumps == 1);
}

BOOST_AUTO_TEST_SUITE_END()
