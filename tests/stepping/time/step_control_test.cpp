#include <boost/test/unit_test.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "bie/geometry/surface.hpp"
#include "bie/stepping/thresholds.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

Matrix example_3_shape(int order) { return ellipsoid(order, {2.0, 1.0, 1.0}); }

StepAttempt advanced(const Model& model, const Discretisation& discretisation, const State& state, double dt_nominal,
                     double dt_limit) {
  Instruments instruments;
  return controlled_step(model, discretisation, state, evaluate(model, discretisation, state, instruments),
                         fixed_steps(dt_nominal), dt_limit, instruments);
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

// A strain that is known is undone by the next step; one that degrees that are cut off must have left stays, and the
// shape and its tension do not feel it.
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

BOOST_AUTO_TEST_CASE(control_halves_until_the_step_is_good_and_recovers) {
  const Discretisation discretisation = discretisation_of(8);
  const Model model = shear_model();
  const double nominal = 32.0;
  const State state = start(model, discretisation, example_3_shape(8), nominal);
  const StepAttempt first = advanced(model, discretisation, state, nominal, nominal);
  BOOST_REQUIRE(first.accepted);
  BOOST_TEST(first.rejected > 0);
  BOOST_TEST(first.dt == nominal / (1 << first.rejected));
  BOOST_TEST(first.state.time == first.dt);
  BOOST_TEST(first.state.dt_next == first.dt);
  // A good step at once doubles what is tried next, up to the nominal size.
  State easy = start(model, discretisation, example_3_shape(8), 0.05);
  const StepAttempt second = advanced(model, discretisation, easy, 0.08, 0.08);
  BOOST_TEST(second.rejected == 0);
  BOOST_TEST(second.dt == 0.05);
  BOOST_TEST(second.state.dt_next == 0.08);
}

BOOST_AUTO_TEST_CASE(step_cut_by_the_limit_does_not_shorten_those_that_follow) {
  const Discretisation discretisation = discretisation_of(8);
  const Model model = shear_model();
  const State state = start(model, discretisation, example_3_shape(8), 0.1);
  const StepAttempt result = advanced(model, discretisation, state, 0.1, 0.003);
  BOOST_TEST(result.dt == 0.003);
  BOOST_TEST(result.state.dt_next == 0.1);
}

BOOST_AUTO_TEST_CASE(sizes_that_fall_go_on_falling) {
  NumericalSettings settings;
  settings.order = 8;
  settings.time_order = highest_time_order;
  const Discretisation discretisation(settings);
  const Model model = shear_model();
  constexpr double kSize = 0.02;
  const State first = start(model, discretisation, example_3_shape(8), kSize);
  Instruments instruments;
  const Evaluation at_start = evaluate(model, discretisation, first, instruments);
  const StepGoal goal{1e-5};
  const auto next = [&](double dt_found) {
    State state = first;
    state.dt_found = dt_found;
    const StepAttempt result =
        controlled_step(model, discretisation, state, at_start, {1.0, 1e-6, goal.tolerance}, kSize, instruments, &goal);
    BOOST_TEST_REQUIRE(result.accepted);
    return result.state;
  };
  const State unknown = next(0.0);
  BOOST_TEST(unknown.dt_next == std::max(unknown.dt_found, unknown.dt_found > kSize ? kSize : 0.0));
  for (const double falls_by : {0.5, 0.9, 1.0, 2.0}) {
    const State state = next(unknown.dt_found / falls_by);
    BOOST_TEST(state.dt_found == unknown.dt_found);
    const double expected = std::min(1.0, falls_by) * unknown.dt_found;
    BOOST_TEST(state.dt_next == std::max(expected, unknown.dt_found > kSize ? kSize : 0.0),
               boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(control_gives_up_with_the_reason_when_no_step_is_good) {
  const Discretisation discretisation = discretisation_of(8);
  const Model model = shear_model();
  State state = start(model, discretisation, example_3_shape(8), 0.1);
  // No motion at this area reaches twice the volume.
  state.vesicles[0].reference_volume *= 2.0;
  StepAttempt result;
  BOOST_CHECK_NO_THROW(result = advanced(model, discretisation, state, 0.1, 0.1));
  BOOST_TEST(!result.accepted);
  BOOST_TEST(!result.reason.empty());
  BOOST_TEST(result.rejected >= 10);
}

BOOST_AUTO_TEST_CASE(initial_state_starts_where_it_is_told) {
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
  // One that is given is taken over in any degree.
  const Vector given = Vector::LinSpaced(n_coefficients(5), -1.0, 2.0);
  const State charged = initial_state(model, discretisation, {{sphere(8), {.given = given}}}, 0.1, instruments);
  BOOST_TEST((charged.vesicles[0].transmembrane_potential.head(given.size()) == given));
  BOOST_TEST(charged.vesicles[0].transmembrane_potential.tail(81 - given.size()).isZero(0.0));
  BOOST_TEST(initial_state(shear_model(), discretisation, {{sphere(8), {}}}, 0.1, instruments)
                 .vesicles[0]
                 .transmembrane_potential.size() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
