#include "bie/estimate/cost.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <regex>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/shipped_scenes.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scenes.hpp"

namespace {

const std::vector<double> tolerances{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7};

/// Large enough that the trial run is limited by steps alone.
constexpr double enough_seconds = 1e6;

vehd::Scene read(const std::string& text) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", text);
  return vehd::read_scene(directory / "scene.toml");
}

/// Steps and degree of a complete run.
struct Taken {
  double steps = 0.0;
  int order = 0;
};

Taken taken(const vehd::Scene& scene, double tolerance) {
  const vehd::Scene asked = vehd::at_tolerance(scene, tolerance);
  const vehd::Problem problem = vehd::problem_of(asked);
  const vehd::EventTimes events = vehd::events_of(asked);
  vehd::Instruments instruments;
  vehd::Evolution evolution(vehd::setup_of(problem), problem.start, instruments);
  evolution.evaluate_start();
  Taken result;
  while (evolution.state().time < events.end_time) {
    evolution.step(events);
    result.steps += 1.0;
    result.order = std::max(result.order, vehd::highest_order_of(evolution.state()));
  }
  return result;
}

/// Factor by which a prediction is wrong, in either direction.
double factor(double predicted, double truth) { return std::max(predicted / truth, truth / predicted); }

}  // namespace

BOOST_AUTO_TEST_SUITE(cost)

BOOST_AUTO_TEST_CASE(every_digit_has_a_price_and_no_digit_is_free) {
  const vehd::Scene scene = read(quick_scene("1.0"));
  for (const std::int64_t steps : {1, 1000}) {
    const auto rows = vehd::cost_table_of(scene, tolerances, {.seconds = enough_seconds, .steps = steps});
    BOOST_TEST_REQUIRE(rows.size() == tolerances.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      BOOST_TEST(rows[i].tolerance == tolerances[i]);
      BOOST_TEST(rows[i].stops == "");
      BOOST_TEST(rows[i].seconds > rows[i].file_seconds);
      BOOST_TEST(rows[i].memory_bytes > 1000000);
      // Only the trial run itself is measured, and only if it reaches the end.
      BOOST_TEST(rows[i].measured == (i == 0 && steps > 1));
      if (i == 0) continue;
      BOOST_TEST(rows[i].order > rows[i - 1].order);
      BOOST_TEST(rows[i].memory_bytes >= rows[i - 1].memory_bytes);
      const double more = static_cast<double>(rows[i].steps) / static_cast<double>(rows[0].steps);
      const double law = std::pow(tolerances[0] / tolerances[i], 1.0 / vehd::highest_time_order);
      BOOST_TEST(more == law, boost::test_tools::tolerance(2.0 / static_cast<double>(rows[0].steps)));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_trial_run_takes_the_steps_of_the_run) {
  const vehd::Scene scene = read(quick_scene("1.0"));
  const Taken truth = taken(scene, 1e-2);
  const vehd::CostRow row = vehd::cost_table_of(scene, tolerances, {.seconds = enough_seconds}).front();
  BOOST_TEST(row.measured);
  BOOST_TEST(static_cast<double>(row.steps) == truth.steps);
  BOOST_TEST(row.order == truth.order);
}

// Both halves of this run behave alike, so its beginning predicts the rest.
BOOST_AUTO_TEST_CASE(the_beginning_of_a_run_predicts_the_rest) {
  const vehd::Scene scene = read(
      "[shape]\nkind = \"ellipsoid\"\naxes = [1.5, 1, 1]\n[membrane]\nbending_modulus = 0.1\n[flow]\nkind = "
      "\"shear\"\nrate = 1\n[numerics]\ntolerance = 1e-2\nend_time = 20\n");
  const double truth = taken(scene, 1e-2).steps;
  const auto predicted = [&](std::int64_t steps) {
    const vehd::CostRow row = vehd::cost_table_of(scene, {1e-2}, {.seconds = enough_seconds, .steps = steps}).back();
    BOOST_TEST(!row.measured);
    return static_cast<double>(row.steps);
  };
  BOOST_TEST(factor(predicted(std::llround(truth / 2.0)), truth) < 1.5);
}

BOOST_AUTO_TEST_CASE(steps_and_degrees_of_the_same_trial_steps_do_not_depend_on_the_clock) {
  const auto rows = [] {
    return vehd::cost_table_of(read(quick_scene("1.0")), tolerances, {.seconds = enough_seconds, .steps = 5});
  };
  const auto first = rows(), second = rows();
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    BOOST_TEST((first[i].order == second[i].order && first[i].steps == second[i].steps));
  }
}

// The degree of the scene is an upper bound for its own tolerance.
BOOST_AUTO_TEST_CASE(a_scene_with_a_tolerance_keeps_its_degree) {
  vehd::Scene scene = read(std::regex_replace(quick_scene("1.0"), std::regex("\ndt = .*"), "\ntolerance = 1e-4"));
  scene.numerics.order = 12;
  const auto rows = vehd::cost_table_of(scene, {1e-2, 1e-4, 1e-6}, {.seconds = enough_seconds});
  BOOST_TEST(rows[1].order <= 12);
  BOOST_TEST(rows[2].order > 12);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(prediction, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

// The accuracy promised for `vehd plan --menu`, independent of timing: nine of ten rows of the shipped scenes.
BOOST_AUTO_TEST_CASE(nine_of_ten_rows_of_the_shipped_scenes_are_within_a_factor_of_two) {
  int n_rows = 0, n_wrong = 0;
  for (const auto& shipped : vehd::shipped_scenes()) {
    const vehd::Scene scene = read(std::string(shipped.text));
    const auto rows = vehd::cost_table_of(scene, {1e-2, 1e-3, 1e-4}, {.seconds = enough_seconds});
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const Taken truth = taken(scene, rows[i].tolerance);
      const bool is_right =
          factor(static_cast<double>(rows[i].steps), truth.steps) < 2.0 && factor(rows[i].order, truth.order) < 1.5;
      BOOST_TEST_MESSAGE(shipped.name << " at " << rows[i].tolerance << ": " << rows[i].steps << " steps for "
                                      << truth.steps << ", degree " << rows[i].order << " for " << truth.order);
      ++n_rows;
      n_wrong += is_right ? 0 : 1;
    }
  }
  BOOST_TEST(n_rows > 20);
  BOOST_TEST(10 * n_wrong <= n_rows);
}

BOOST_AUTO_TEST_SUITE_END()
