#include <boost/test/unit_test.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "bie/geometry/surface.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

Matrix example_3_shape(int order) { return ellipsoid(order, {2.0, 1.0, 1.0}); }

EvolutionSetup in_shear(const Matrix& position, double dt) {
  EvolutionSetup setup;
  setup.model = shear_model();
  setup.settings.order = order_of(position.rows());
  setup.symmetry = find_symmetry(setup.model, at_rest(position));
  setup.control = fixed_steps(dt);
  return setup;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(step_control)

BOOST_AUTO_TEST_CASE(accepted_step_holds_area_and_volume_to_the_tolerance) {
  const Discretisation discretisation = discretisation_of(12);
  const double tolerance = discretisation.settings().constraint_tolerance;
  for (const Model& model : {relaxation_model(0.1), shear_model(), field_model()}) {
    const State state = start(model, discretisation, example_3_shape(12), 0.1);
    const StepAttempt result = stepped(model, discretisation, state, 0.1);
    BOOST_REQUIRE(result.accepted);
    BOOST_TEST(result.reason.empty());
    BOOST_TEST(result.state.time == 0.1);
    BOOST_TEST(result.state.step == 1);
    const Surface after = make_surface(discretisation.vesicle(0).fine_transform(), result.state.vesicles[0].position);
    BOOST_TEST(std::abs(surface_area(after) / state.vesicles[0].reference_area - 1.0) <= tolerance);
    BOOST_TEST(std::abs(enclosed_volume(after) / state.vesicles[0].reference_volume - 1.0) <= tolerance);
    BOOST_TEST(max_difference(result.state.vesicles[0].position, state.vesicles[0].position) > 1e-4);
  }
}

// A strain up to known_strain is undone by the next step; a larger one, attributed to truncated degrees, stays and does
// not affect the shape and its tension.
BOOST_AUTO_TEST_CASE(strain_is_taken_back_as_far_as_it_is_known) {
  const Discretisation discretisation = discretisation_of(12);
  const Model model = relaxation_model(0.1);
  const State clean = start(model, discretisation, example_3_shape(12), 0.01);
  const State after_clean = stepped(model, discretisation, clean, 0.01).state;
  const Vector pattern = harmonic(12, 4, 2) - 0.7 * harmonic(12, 3, -1);
  const double largest =
      discretisation.vesicle(0).fine_transform().synthesize(pattern).cwiseAbs().maxCoeff() / thresholds::known_strain;
  const auto after = [&](double strain) {
    State state = clean;
    state.vesicles[0].area_strain = strain / largest * pattern;
    const StepAttempt result = stepped(model, discretisation, state, 0.01);
    BOOST_TEST_REQUIRE(result.accepted);
    return std::pair(result.state.vesicles[0].area_strain.norm() / state.vesicles[0].area_strain.norm(),
                     max_difference(result.state.vesicles[0].position, after_clean.vesicles[0].position));
  };
  const auto [left_of_known, moved_by_known] = after(0.9);
  BOOST_TEST(left_of_known < 0.01);
  BOOST_TEST(moved_by_known > 1e-4);
  const auto [left_of_half, moved_by_half] = after(1.5);
  BOOST_TEST(left_of_half == 0.5, boost::test_tools::tolerance(0.02));
  const auto [left_of_unknown, moved_by_unknown] = after(2.5);
  BOOST_TEST(left_of_unknown == 1.0, boost::test_tools::tolerance(0.02));
  BOOST_TEST(moved_by_unknown < 1e-9);
}

BOOST_AUTO_TEST_CASE(sphere_under_bending_alone_does_not_move) {
  const Discretisation discretisation = discretisation_of(12);
  const Model model = relaxation_model(1.0);
  const State end = run(model, discretisation, start(model, discretisation, sphere(12), 1.0), 1.0, 5);
  BOOST_TEST(max_difference(end.vesicles[0].position, sphere(12)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(absurd_step_is_rejected_with_a_reason) {
  const Discretisation discretisation = discretisation_of(8);
  for (const Model& model : {shear_model(), field_model()}) {
    const State state = start(model, discretisation, example_3_shape(8), 0.1);
    for (const double dt : {1e3, 1e8}) {
      StepAttempt result;
      BOOST_CHECK_NO_THROW(result = stepped(model, discretisation, state, dt));
      BOOST_TEST(!result.accepted);
      BOOST_TEST(!result.reason.empty());
    }
  }
}

BOOST_AUTO_TEST_CASE(steps_are_halved_until_they_are_good_and_recover) {
  constexpr double kNominal = 32.0;
  const Matrix position = example_3_shape(8);
  Instruments instruments;
  Evolution evolution(in_shear(position, kNominal), {StartMembrane{position}}, instruments);
  evolution.evaluate_start();
  const StepAttempt first = evolution.step({{}, kNominal});
  BOOST_TEST(first.rejected > 0);
  BOOST_TEST(first.dt == kNominal / (1 << first.rejected));
  BOOST_TEST(evolution.state().time == first.dt);
  BOOST_TEST(evolution.state().dt_next == first.dt);
}

BOOST_AUTO_TEST_CASE(size_of_fixed_steps_doubles_back_to_the_nominal_one) {
  const StepControl control = fixed_steps(0.08);
  State start;
  start.dt_next = 0.02;
  StepAttempt accepted;
  accepted.dt = 0.02;
  set_next_size(control, start, {.dt_next = 0.02, .dt = 0.02}, accepted);
  BOOST_TEST(accepted.state.dt_next == 0.04);
  set_next_size(control, start, {.dt_next = 0.05, .dt = 0.05}, accepted);
  BOOST_TEST(accepted.state.dt_next == 0.08);
  // A step that an event cuts short does not shorten those that follow.
  accepted.dt = 0.003;
  set_next_size(control, start, {.dt_next = 0.08, .dt = 0.003}, accepted);
  BOOST_TEST(accepted.state.dt_next == 0.08);
  accepted.rejected = 1;
  set_next_size(control, start, {.dt_next = 0.04, .dt = 0.04}, accepted);
  BOOST_TEST(accepted.state.dt_next == 0.04);
}

BOOST_AUTO_TEST_CASE(sizes_that_fall_go_on_falling) {
  const StepControl control{1.0, 1e-6, 1e-5};
  State start;
  StepAttempt accepted;
  accepted.dt = 0.02;
  const auto next = [&](double dt_found, double factor) {
    start.dt_found = dt_found;
    accepted.factor = factor;
    set_next_size(control, start, {.dt_next = 0.03, .dt = 0.02}, accepted);
    BOOST_TEST(accepted.state.dt_found == factor * 0.02);
    return accepted.state.dt_next;
  };
  const auto rounding = boost::test_tools::tolerance(1e-14);
  BOOST_TEST(next(0.0, 0.5) == 0.01, rounding);
  BOOST_TEST(next(0.01, 0.5) == 0.01, rounding);
  BOOST_TEST(next(0.02, 0.5) == 0.005, rounding);
  BOOST_TEST(next(0.005, 0.5) == 0.01, rounding);
  BOOST_TEST(next(0.02, 4.0) == 0.08, rounding);
  // The step was cut short by an event, and its size was found to be too small.
  BOOST_TEST(next(0.02, 1.2) == 0.03, rounding);
  BOOST_TEST(next(0.0, 100.0) == 1.0, rounding);
}

BOOST_AUTO_TEST_CASE(a_rejected_step_is_repeated_in_a_smaller_size) {
  StepAttempt rejected;
  rejected.dt = 0.2;
  rejected.factor = 1.5;
  BOOST_TEST(smaller_size(rejected) < rejected.dt);
  rejected.reject("it does not converge");
  BOOST_TEST(smaller_size(rejected) == 0.1);
}

BOOST_AUTO_TEST_CASE(way_ends_with_the_reason_where_no_step_is_good) {
  const Matrix position = example_3_shape(8);
  const EvolutionSetup setup = in_shear(position, 0.1);
  State state = start(setup.model, Discretisation(setup.settings, setup.symmetry), position, 0.1);
  // No motion can double the volume at this area.
  state.vesicles[0].reference_volume *= 2.0;
  Instruments instruments;
  Evolution evolution(setup, state, instruments);
  evolution.evaluate_start();
  BOOST_CHECK_EXCEPTION(evolution.step({{}, 1.0}), ConvergenceError, [](const ConvergenceError& error) {
    const std::string text = error.what();
    return text.starts_with("no acceptable step from time 0: ") && text.find("rounding") == std::string::npos;
  });
  BOOST_TEST(evolution.state().time == 0.0);
}

BOOST_AUTO_TEST_CASE(initial_state_starts_at_the_given_place) {
  const Discretisation discretisation = discretisation_of(8);
  Instruments instruments;
  const Model model = field_model();
  const State zero = initial_state(model, discretisation, {{sphere(8), {}}}, 0.1, instruments);
  BOOST_TEST(zero.vesicles[0].transmembrane_potential.isZero(0.0));
  BOOST_TEST(zero.vesicles[0].area_strain.isZero(0.0));
  BOOST_TEST(zero.dt_next == 0.1);
  // Steady V = (3E/2) κ/(κ + G_m) with κ = 2σ_iσ_e/(σ_i + 2σ_e) = 4/5.
  const State steady = initial_state(model, discretisation, {{sphere(8), {.steady = true}}}, 0.1, instruments);
  BOOST_TEST(max_difference(steady.vesicles[0].transmembrane_potential, 1.5 * 0.8 / 5.8 * sphere(8).col(2)) < 1e-9);
  // A given potential may have any degree.
  const Vector given = Vector::LinSpaced(n_coefficients(5), -1.0, 2.0);
  const State charged = initial_state(model, discretisation, {{sphere(8), {.given = given}}}, 0.1, instruments);
  BOOST_TEST((charged.vesicles[0].transmembrane_potential.head(given.size()) == given));
  BOOST_TEST(charged.vesicles[0].transmembrane_potential.tail(81 - given.size()).isZero(0.0));
  BOOST_TEST(initial_state(shear_model(), discretisation, {{sphere(8), {}}}, 0.1, instruments)
                 .vesicles[0]
                 .transmembrane_potential.size() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
