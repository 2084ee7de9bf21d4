#include "bie/support/progress.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(summary)

BOOST_AUTO_TEST_CASE(durations_are_readable) {
  BOOST_TEST(vehd::duration_text(0.25) == "0.2 s");
  BOOST_TEST(vehd::duration_text(59.4) == "59 s");
  BOOST_TEST(vehd::duration_text(125.0) == "2:05");
  BOOST_TEST(vehd::duration_text(3723.0) == "1:02:03");
}

BOOST_AUTO_TEST_SUITE_END()
