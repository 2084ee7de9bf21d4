#include "bie/stepping/time/next_step.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "bie/stepping/thresholds.hpp"

using namespace vehd;

namespace {

constexpr double kSize = 0.2;
constexpr int kNodes = 3;

/// Errors that contract by a tenth a sweep, from this one on.
std::vector<double> after(double first) { return {first, 0.1 * first, 0.01 * first, 0.001 * first}; }

NextStep after_step(const StepErrors& errors, Beginning beginning = Beginning::afresh, bool accepted = true,
                    const Past& past = {}) {
  return next_step(errors, past, kSize, kNodes, beginning, accepted);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(next_step)

BOOST_AUTO_TEST_CASE(size_is_the_one_that_gets_on_at_the_least_cost) {
  const StepErrors errors{1.0, after(3.0), 30.0};
  const NextStep next = after_step(errors);
  BOOST_TEST((next.beginning == Beginning::afresh));
  // Of two, three and four sweeps, with the power of dt that each falls with.
  double least = 1e300, best = 0.0;
  for (int j = 2; j <= 4; ++j) {
    const double factor =
        thresholds::step_safety * std::pow(1.0 / errors.after[static_cast<std::size_t>(j - 1)], 1.0 / (j + 1));
    if (const double cost = (2 + kNodes * j) / factor; cost < least) {
      least = cost;
      best = factor;
    }
  }
  BOOST_TEST(next.factor == best, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(past_is_continued_where_it_is_near_enough) {
  BOOST_TEST((after_step({1.0, after(3.0), 30.0, 0.3}).beginning == Beginning::with_past));
  BOOST_TEST((after_step({1.0, after(3.0), 30.0, 300.0}).beginning == Beginning::afresh));
  BOOST_TEST((after_step({1.0, after(3.0), 30.0, {}}).beginning == Beginning::afresh));
  // However exact it is, no further than it reaches.
  BOOST_TEST(after_step({1.0, after(3.0), 30.0, 1e-9}).factor == thresholds::longest_continuation);
}

BOOST_AUTO_TEST_CASE(step_that_was_not_good_enough_is_not_repeated_in_a_way_that_was_not_tried) {
  const StepErrors errors{1.0, after(3.0), 30.0, 0.3};
  BOOST_TEST((after_step(errors, Beginning::afresh, false).beginning == Beginning::afresh));
  BOOST_TEST(after_step(errors, Beginning::afresh, false).afresh_errors.size() == 0);
}

BOOST_AUTO_TEST_CASE(steps_that_begin_with_the_past_know_what_those_that_begin_afresh_would_cost) {
  const StepErrors afresh_errors{1.0, after(3.0), 30.0, 1.0};
  const NextStep afresh = after_step(afresh_errors);
  BOOST_TEST(afresh.afresh_dt == kSize);
  const Past past{Vector{{-kSize}}, 1, afresh.afresh_dt, afresh.afresh_errors};
  // The same motion in a step as long: what would be left is what was.
  const NextStep slow = after_step({1.0, after(1e6), 30.0, 1e6}, Beginning::with_past, true, past);
  BOOST_TEST((slow.beginning == Beginning::afresh));
  BOOST_TEST(slow.factor == after_step({1.0, after(3.0), 30.0}).factor, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(
      (after_step({1.0, after(0.1), 30.0, 1.0}, Beginning::with_past, true, past).beginning == Beginning::with_past));
  // Sweeps contract like the size: the last one of a step half as long would be made with a sixteenth.
  const Past longer{Vector{{-kSize}}, 1, 2.0 * kSize, afresh.afresh_errors};
  std::vector<double> contracted = after(3.0);
  for (std::size_t j = 0; j < contracted.size(); ++j) contracted[j] *= std::pow(0.5, j + 1.0);
  const NextStep shorter = after_step({1.0, after(1e6), 30.0, 1e6}, Beginning::with_past, true, longer);
  BOOST_TEST(shorter.factor == after_step({1.0, contracted, 30.0}).factor, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(without_a_step_that_began_afresh_the_past_goes_on) {
  const Past past{Vector{{-kSize}}, 1, 0.0, {}};
  BOOST_TEST(
      (after_step({1.0, after(1e6), 30.0, 1e6}, Beginning::with_past, true, past).beginning == Beginning::with_past));
}

BOOST_AUTO_TEST_CASE(all_errors_in_another_unit_ask_for_the_same) {
  constexpr double kUnit = 1e-7;
  std::vector<double> small = after(3.0);
  for (double& error : small) error *= kUnit;
  const NextStep here = after_step({1.0, after(3.0), 30.0, 5.0});
  const NextStep there = after_step({kUnit, small, 30.0 * kUnit, 5.0 * kUnit});
  BOOST_TEST((here.beginning == there.beginning));
  BOOST_TEST(here.factor == there.factor, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
