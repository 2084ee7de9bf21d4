#include "bie/stepping/time/step_plan.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(step_plan)

BOOST_AUTO_TEST_CASE(steps_end_exactly_on_every_snapshot) {
  for (const double dt : {0.5, 0.3, 0.07, 2.0}) {
    const vehd::EventTimes events{{0.1}, 12.3};
    double time = 0.0;
    int snapshots = 0;
    while (time < events.end_time) {
      const vehd::StepPlan plan = vehd::plan_step(time, dt, events);
      BOOST_TEST_REQUIRE(plan.dt_limit > 0.0);
      BOOST_TEST_REQUIRE(plan.dt_limit <= dt * (1.0 + 1e-9));
      time = plan.reaches_event ? plan.event_time : time + plan.dt_limit;
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
  BOOST_TEST(plan.dt_limit == 0.25);
  BOOST_TEST(!plan.reaches_event);
  // One rounding error more than dt is still one step.
  BOOST_TEST(vehd::plan_step(0.0, 0.1, {{}, 0.1 * (1.0 + 1e-12)}).reaches_event);
}

BOOST_AUTO_TEST_CASE(end_that_rounds_onto_a_snapshot_is_one_event) {
  const vehd::StepPlan plan = vehd::plan_step(0.2, 1.0, {{0.1}, 0.3});
  BOOST_TEST(plan.event_time == 0.3);
  BOOST_TEST(plan.reaches_event);
}

BOOST_AUTO_TEST_SUITE_END()
