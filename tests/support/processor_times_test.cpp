#include "bie/support/processor_times.hpp"

#include <boost/test/unit_test.hpp>
#include <stdexcept>

BOOST_AUTO_TEST_SUITE(processor_times)

BOOST_AUTO_TEST_CASE(idle_time_is_that_without_work_or_waiting_for_a_disk) {
  BOOST_TEST(vehd::idle_seconds("cpu  1000 20 300 4000 500 6 7 8 9 10\ncpu0 1 2 3 4 5\n", 100.0) == 45.0);
  for (const char* text : {"", "cpu", "cpu 1 2 3 4", "intr 1 2 3 4 5 6"}) {
    BOOST_CHECK_THROW(vehd::idle_seconds(text, 100.0), std::invalid_argument);
  }
}

BOOST_AUTO_TEST_CASE(processors_that_others_use_are_not_left) {
  const vehd::ProcessorTimes begin{100.0, 50.0, 10.0};
  const auto left = [&](double idle, double own, int most) {
    return vehd::processors_left(begin, {begin.elapsed + 10.0, begin.idle + idle, begin.own + own}, most);
  };
  // Two processors: idle, busy only here, shared with one other process, used by others.
  BOOST_TEST(left(20.0, 0.0, 2) == 2);
  BOOST_TEST(left(0.5, 18.5, 2) == 2);
  BOOST_TEST(left(0.0, 12.0, 2) == 1);
  BOOST_TEST(left(0.0, 3.0, 2) == 1);
  // 64 processors, of which this process may use four or all.
  BOOST_TEST(left(600.0, 20.0, 4) == 4);
  BOOST_TEST(left(200.0, 20.0, 64) == 22);
  // Nothing has been measured yet.
  BOOST_TEST(vehd::processors_left(begin, begin, 8) == 8);
}

BOOST_AUTO_TEST_CASE(times_grow) {
  const vehd::ProcessorTimes begin = vehd::processor_times();
  volatile double work = 0.0;
  vehd::ProcessorTimes end = begin;
  while (end.own < begin.own + 0.02) {
    for (int i = 0; i < 100000; ++i) work = work + 1.0;
    end = vehd::processor_times();
  }
  BOOST_TEST(end.elapsed > begin.elapsed);
  BOOST_TEST(end.idle >= begin.idle);
  BOOST_TEST(vehd::processors_left(begin, end, 2) >= 1);
}

BOOST_AUTO_TEST_SUITE_END()
