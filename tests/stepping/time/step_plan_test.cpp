#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <vector>

#include "bie/stepping/time/step_control.hpp"

BOOST_AUTO_TEST_SUITE(step_plan)

BOOST_AUTO_TEST_CASE(steps_end_exactly_on_every_snapshot) {
  for (const double dt : {0.5, 0.3, 0.07, 2.0}) {
    const vehd::EventTimes events{{0.1}, 12.3};
    double time = 0.0;
    int snapshots = 0;
    while (time < events.end_time) {
      const vehd::StepPlan plan = vehd::plan_step(time, dt, events);
      BOOST_TEST_REQUIRE(plan.dt > 0.0);
      BOOST_TEST_REQUIRE(plan.dt <= dt * (1.0 + 1e-9));
      time = plan.reaches_event ? plan.event_time : time + plan.dt;
      if (!plan.reaches_event) continue;
      ++snapshots;
      BOOST_TEST_REQUIRE((time == snapshots * 0.1 || time == events.end_time));
    }
    BOOST_TEST(snapshots == 123);
    BOOST_TEST(time == events.end_time);
  }
}

BOOST_AUTO_TEST_CASE(no_sliver_is_left) {
  const vehd::StepPlan plan = vehd::plan_step(0.0, 0.3, {{}, 1.0});
  BOOST_TEST(plan.dt == 0.25);
  BOOST_TEST(!plan.reaches_event);
  // An interval longer than dt by one rounding error is still one step.
  BOOST_TEST(vehd::plan_step(0.0, 0.1, {{}, 0.1 * (1.0 + 1e-12)}).reaches_event);
}

BOOST_AUTO_TEST_CASE(end_that_rounds_onto_a_snapshot_is_one_event) {
  const vehd::StepPlan plan = vehd::plan_step(0.2, 1.0, {{0.1}, 0.3});
  BOOST_TEST(plan.event_time == 0.3);
  BOOST_TEST(plan.reaches_event);
}

namespace {

/// Snapshot times of a run with these steps; `most` is the longest step.
std::vector<double> snapshots_of(const vehd::EventTimes& events, double dt, double* most = nullptr) {
  std::vector<double> moments;
  double time = 0.0;
  while (time < events.end_time) {
    const vehd::StepPlan plan = vehd::plan_step(time, dt, events);
    if (most != nullptr) *most = std::max(*most, plan.dt);
    time = plan.reaches_event ? plan.event_time : time + plan.dt;
    if (plan.reaches_event) moments.push_back(time);
  }
  return moments;
}

}  // namespace

BOOST_AUTO_TEST_CASE(snapshots_come_at_several_rates) {
  const vehd::EventTimes events{{1.0, {0.75, 2.5}, {{0.0, 0.3, 0.1}, {2.0, 2.2, 0.05}}}, 4.0};
  const std::vector<double> expected = {0.1, 0.2, 0.3, 0.75, 1.0, 2.0, 2.05, 2.1, 2.15, 2.2, 2.5, 3.0, 4.0};
  const std::vector<double> found = snapshots_of(events, 10.0);
  BOOST_TEST_REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    BOOST_TEST(found[i] == expected[i], boost::test_tools::tolerance(1e-14));
  }
  // Each time counts once: the start does not count, and a time in several schedules counts once.
  BOOST_TEST(events.snapshots.count(4.0) == 4.0 + 2.0 + 3.0 + 4.0, boost::test_tools::tolerance(1e-12));
}

// Times that several schedules contain differ by rounding: a sliver between them would be a step of its own.
BOOST_AUTO_TEST_CASE(times_requested_twice_are_one) {
  std::vector<double> tenths;
  for (int k = 1; k < 50; ++k) tenths.push_back(k / 10.0);
  const vehd::EventTimes events{{0.1, tenths, {{0.0, 5.0, 0.1}, {0.2, 4.8, 0.2}, {0.7, 5.0, 0.1}}}, 5.0};
  BOOST_TEST(snapshots_of(events, 1.0).size() == 50U);
}

BOOST_AUTO_TEST_CASE(steps_are_no_shorter_than_their_snapshots_need) {
  const vehd::EventTimes events{{2.0, {}, {{1.0, 1.1, 0.01}}}, 10.0};
  double longest = 0.0;
  snapshots_of(events, 0.5, &longest);
  BOOST_TEST(longest == 0.5);
  // Before, in and after the window.
  BOOST_TEST(vehd::plan_step(0.0, 0.5, events).dt == 0.5);
  BOOST_TEST(vehd::plan_step(1.0, 0.5, events).dt == 0.01, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(vehd::plan_step(1.1, 0.5, events).dt == 0.45, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(vehd::plan_step(2.0, 0.5, events).dt == 0.5);
}

BOOST_AUTO_TEST_SUITE_END()
