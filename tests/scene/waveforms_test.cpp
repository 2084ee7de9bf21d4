#include "bie/scene/waveforms.hpp"

#include <boost/test/unit_test.hpp>
#include <random>

BOOST_AUTO_TEST_SUITE(waveforms_of_a_scene)

namespace {

vehd::WaveformScene waveform(vehd::WaveformKind kind, double start, double duration, double period) {
  vehd::WaveformScene result;
  result.kind = kind;
  result.start = start;
  result.duration = duration;
  result.period = period;
  return result;
}

int walked(const vehd::WaveformScene& waveform, double end) {
  const vehd::Waveform walked = vehd::waveform_of(waveform);
  int count = 0;
  for (auto time = walked.next_discontinuity(0.0); time && *time <= end; time = walked.next_discontinuity(*time))
    ++count;
  return count;
}

}  // namespace

BOOST_AUTO_TEST_CASE(steps_of_pulses_are_counted_as_they_come) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0.1, 1.0);
  for (int i = 0; i < 200; ++i) {
    const double start = 4.0 * number(random) - 2.0, duration = number(random), end = 9.0 * number(random);
    for (const auto kind : {vehd::WaveformKind::pulse, vehd::WaveformKind::pulse_train}) {
      const vehd::WaveformScene pulses = waveform(kind, start, duration, duration + number(random));
      BOOST_TEST(vehd::fewest_steps(pulses, end) == walked(pulses, end));
    }
  }
}

BOOST_AUTO_TEST_CASE(steps_of_a_table_are_its_times) {
  vehd::WaveformScene table = waveform(vehd::WaveformKind::table, 0.0, 0.0, 0.0);
  table.times = {-1.0, 0.0, 0.5, 1.0, 2.0, 3.0};
  table.values = {0.0, 1.0, 0.0, 1.0, 0.0, 1.0};
  BOOST_TEST(vehd::fewest_steps(table, 2.0) == 3.0);
  BOOST_TEST(walked(table, 2.0) == 3);
}

BOOST_AUTO_TEST_CASE(steps_of_a_burst_are_those_of_its_periods_and_both_ends) {
  vehd::WaveformScene burst = waveform(vehd::WaveformKind::burst, 0.5, 2.0, 0.0);
  burst.frequency = 3.0;
  BOOST_TEST(vehd::fewest_steps(burst, 4.0) == 6.0 * vehd::fewest_steps_a_period + 2.0);
  BOOST_TEST(vehd::fewest_steps(burst, 1.5) == 3.0 * vehd::fewest_steps_a_period + 1.0);
  BOOST_TEST(vehd::fewest_steps(burst, 0.4) == 0.0);
}

BOOST_AUTO_TEST_CASE(steps_of_alternating_and_other_waveforms) {
  vehd::WaveformScene alternating = waveform(vehd::WaveformKind::ac, 0.0, 0.0, 0.0);
  alternating.frequency = 3.0;
  BOOST_TEST(vehd::fewest_steps(alternating, 2.0) == 6.0 * vehd::fewest_steps_a_period);
  BOOST_TEST(vehd::fewest_steps(waveform(vehd::WaveformKind::dc, 0.0, 0.0, 0.0), 2.0) == 0.0);
}

BOOST_AUTO_TEST_SUITE_END()
