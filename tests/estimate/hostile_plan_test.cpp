#include <boost/test/unit_test.hpp>

#include "bie/estimate/cost.hpp"
#include "tests/scene/key_values.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(hostile_plan)

namespace {

/// Line 1 is [shape]; [numerics] holds the degree 6 and `keys`, which set the end of a short run.
std::string scene_with_numerics(const std::string& keys, const std::string& more = "") {
  return "[shape]\nkind = 'ellipsoid'\naxes = [1, 1, 1.5]\n[membrane]\nbending_modulus = 0.1\n[numerics]\norder = 6\n" +
         keys + more;
}

const std::string kField = "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\n";

/// Plan with the cost, measured within the given seconds or slightly more.
vehd::RunPlan planned(const std::string& text, double seconds = 2.0) {
  const vehd::Scene scene = parsed(text);
  vehd::RunPlan plan = vehd::plan_of(scene);
  vehd::predict_cost(scene, plan, {.seconds = seconds});
  return plan;
}

}  // namespace

// Stepping through the jumps one by one would take minutes and exceed the time limit of the tests.
BOOST_AUTO_TEST_CASE(many_jumps_are_counted_without_looking_at_each) {
  const std::string train = kField + "[electric.waveform]\nkind = 'pulse_train'\nduration = 1e-9\nperiod = 4e-9\n";
  const vehd::RunPlan adaptive = planned(scene_with_numerics("tolerance = 1e-2\nend_time = 1\n", train));
  BOOST_TEST(static_cast<double>(adaptive.n_jumps) == 5e8, boost::test_tools::tolerance(1e-7));
  const vehd::RunPlan fixed = planned(scene_with_numerics("dt = 0.1\nend_time = 1\n", train));
  BOOST_TEST(static_cast<double>(fixed.n_steps) == 5e8, boost::test_tools::tolerance(1e-7));
  BOOST_TEST(fixed.seconds_per_step > 0.0);
}

BOOST_AUTO_TEST_CASE(many_snapshots_are_as_many_steps) {
  std::string listed;
  for (int i = 0; i < 20000; ++i) listed += fmt::format("{:.7f}, ", 1e-7 * i);
  for (const std::string& output :
       {std::string("window = [{from = 0, to = 0.01, every = 5e-7}]\n"), "times = [" + listed + "0.1]\n"}) {
    const vehd::RunPlan plan = planned(scene_with_numerics("dt = 0.05\nend_time = 0.2\n", "[output]\n" + output));
    BOOST_TEST(plan.n_steps > 20000);
    BOOST_TEST(plan.n_steps < 20010);
    BOOST_TEST(plan.seconds_per_step > 0.0);
  }
}

BOOST_AUTO_TEST_CASE(a_table_of_many_jumps_is_planned) {
  std::string times, values;
  for (int i = 0; i < 2000; ++i) {
    times += fmt::format("{:.6f}, {:.6f}, ", 1e-5 * i, 1e-5 * i);
    values += "0, 1, ";
  }
  const std::string table =
      kField + "[electric.waveform]\nkind = 'table'\ntimes = [" + times + "]\nvalues = [" + values + "]\n";
  for (const char* keys : {"dt = 0.05\nend_time = 0.2\n", "tolerance = 1e-2\nend_time = 0.2\n"}) {
    const vehd::RunPlan plan = planned(scene_with_numerics(keys, table));
    BOOST_TEST(plan.n_jumps == 1999);
    BOOST_TEST(plan.stops == "");
  }
}

// Without measuring time the cost is unknown, which is no statement about the run.
BOOST_AUTO_TEST_CASE(costs_without_time_to_measure_them_are_unknown) {
  for (const char* keys : {"dt = 0.1\nend_time = 1\n", "tolerance = 1e-2\nend_time = 1\n"}) {
    const vehd::RunPlan plan = planned(scene_with_numerics(keys, kField), 0.0);
    BOOST_TEST(plan.stops == "");
    BOOST_TEST(plan.unknown != "");
    BOOST_TEST(plan.seconds_per_step == 0.0);
  }
}

// Trial runs use lower degrees than the scene; modes of the shape and the membrane may exceed them.
BOOST_AUTO_TEST_CASE(modes_of_a_higher_degree_than_that_of_trial_runs) {
  const std::string text =
      "[shape]\nkind = 'radial'\nmodes = [{n = 30, m = 0, a = 0.02}]\n[membrane]\nbending_modulus = 0.1\n"
      "[membrane.varying_bending]\nkind = 'harmonics'\nmodes = [{n = 30, m = 0, a = 0.1}]\n[numerics]\ndegree = 32\n";
  BOOST_CHECK_NO_THROW(planned(text + "tolerance = 1e-4\nend_time = 1e-4\n"));
  BOOST_CHECK_NO_THROW(planned(text + "dt = 1e-4\nend_time = 1e-4\n"));
}

// Largest and smallest numbers accepted by each key.
BOOST_AUTO_TEST_CASE(every_number_that_is_accepted_can_be_planned) {
  int count = 0;
  for (const vehd::KeyDescription& key : vehd::scene_keys()) {
    for (const char* number : {"1e50", "-1e50", "1e25", "1e-25", "1e-50", "1e308", "-0.0"}) {
      const std::string text = scene_with(key, value_with_number(key, number));
      if (value_with_number(key, number).empty() || !message_of(text).empty()) continue;
      BOOST_TEST_CONTEXT(text) { BOOST_CHECK_NO_THROW(planned(text, 1.0)); }
      ++count;
    }
  }
  BOOST_TEST(count > 20);
}

BOOST_AUTO_TEST_SUITE_END()
