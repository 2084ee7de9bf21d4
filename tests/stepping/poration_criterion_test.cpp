#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/stepping/evolution.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/several_runs.hpp"
#include "tests/support/shapes.hpp"

BOOST_AUTO_TEST_SUITE(poration_criterion)

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr double radius = 2.0, field = 0.7;

/// A frozen sphere between fluids of σ_i = 1, σ_e = 2.
Model charging_sphere(double capacitance) {
  Model model;
  set_electric(model, {{0.0, 0.0, field}, 1.0, 2.0, 1.0}, {capacitance, 0.0});
  model.mobile = false;
  return model;
}

/// τ = a C_m (1/σ_i + 1/(2σ_e)).
double charging_time(double capacitance) { return radius * capacitance * 1.25; }

EvolutionSetup fixed_setup(const Model& model, const Matrix& position, int time_order, double dt) {
  EvolutionSetup setup;
  setup.model = model;
  setup.settings.order = order_of(position.rows());
  setup.settings.time_order = time_order;
  setup.symmetry = find_symmetry(model, at_rest(position));
  setup.control = fixed_steps(dt);
  return setup;
}

VesicleDiagnostics diagnostics_at(const EvolutionSetup& setup, const Matrix& position, double end) {
  Instruments instruments;
  Evolution evolution(setup, {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  while (evolution.state().time < end) evolution.step({{}, end});
  return evolution.evaluation().diagnostics.vesicles[0];
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_sphere_porates_when_and_where_its_closed_form_says) {
  const double capacitance = 0.6, tau = charging_time(capacitance);
  Model model = charging_sphere(capacitance);
  for (const double share : {0.2, 0.632, 0.9}) {
    model.vesicles[0].criterion = PorationCriterion{.potential = share * 1.5 * field * radius};
    const double exact = -tau * std::log(1.0 - share);
    // Seven steps per charging time, none of which ends at the exact time.
    const EvolutionSetup setup = fixed_setup(model, radius * sphere(4), 4, tau / 7.0);
    const VesicleDiagnostics d = diagnostics_at(setup, radius * sphere(4), 3.0 * tau);
    BOOST_TEST(std::abs(d.poration_time / exact - 1.0) < 2e-5, share << ": " << d.poration_time << " " << exact);
    BOOST_TEST(std::abs(d.poration_z - radius) < 1e-12);
    BOOST_TEST(std::hypot(d.poration_x, d.poration_y) < 1e-12);
    BOOST_TEST(std::abs(d.poration_load * share - (1.0 - std::exp(-3.0))) < 1e-4);
  }
}

BOOST_AUTO_TEST_CASE(steps_of_a_tolerance_find_the_same_time) {
  const double capacitance = 0.6, tau = charging_time(capacitance);
  Model model = charging_sphere(capacitance);
  model.vesicles[0].criterion = PorationCriterion{.potential = 1.0 * field * radius};
  EvolutionSetup setup = fixed_setup(model, radius * sphere(4), 4, tau);
  setup.control.tolerance = 1e-4;
  setup.control.smallest = 1e-9 * tau;
  const double exact = -tau * std::log(1.0 - 1.0 / 1.5);
  const VesicleDiagnostics d = diagnostics_at(setup, radius * sphere(4), 3.0 * tau);
  BOOST_TEST(std::abs(d.poration_time / exact - 1.0) < 1e-3, d.poration_time << " " << exact);
}

BOOST_AUTO_TEST_CASE(a_criterion_that_is_never_met_has_no_time) {
  const double capacitance = 0.6, tau = charging_time(capacitance);
  Model model = charging_sphere(capacitance);
  model.vesicles[0].criterion = PorationCriterion{.potential = 1.51 * field * radius};
  const VesicleDiagnostics d =
      diagnostics_at(fixed_setup(model, radius * sphere(4), 1, tau), radius * sphere(4), 20.0 * tau);
  BOOST_TEST(std::isinf(d.poration_time));
  BOOST_TEST(std::isnan(d.poration_x));
  BOOST_TEST(d.poration_load < 1.0);
}

BOOST_AUTO_TEST_CASE(tension_and_half_of_the_stored_charge_add_up) {
  Model model = field_model();
  model.vesicles[0].criterion = PorationCriterion{.tension = 2.0};
  const Matrix position = prolate(8);
  const Discretisation discretisation = symmetric_discretisation(model, position);
  State state = start(model, discretisation, position, 0.01);
  state.vesicles[0].transmembrane_potential = Vector::Zero(position.rows());
  state.vesicles[0].transmembrane_potential[0] = 3.0 * std::sqrt(4.0 * std::numbers::pi);
  const VesicleDiagnostics d = evaluated(model, discretisation, state).diagnostics;
  // C_m = 1 and V_m = 3 everywhere.
  BOOST_TEST(std::abs(d.poration_load - (d.tension_max + 4.5) / 2.0) < 1e-9 * d.poration_load);
}

BOOST_AUTO_TEST_CASE(a_field_that_jumps_may_meet_it_with_its_tension_at_once) {
  Model model = field_model();
  model.vesicles[0].criterion = PorationCriterion{.tension = 1.0};
  model.electric->waveform = Waveform::pulse(1.0, 0.02, 1.0);
  model.electric->field *= 10.0;
  // The inside conducts better, so the field stretches the membrane.
  model.vesicles[0].inside.conductivity = 20.0;
  const EvolutionSetup setup = fixed_setup(model, prolate(8), 1, 0.01);
  const VesicleDiagnostics d = diagnostics_at(setup, prolate(8), 0.05);
  BOOST_TEST(d.poration_time == 0.02);
}

BOOST_AUTO_TEST_SUITE_END()
