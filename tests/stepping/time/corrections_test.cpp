#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/stepping/thresholds.hpp"
#include "bie/stepping/time/deferred_correction.hpp"

using namespace vehd;

BOOST_AUTO_TEST_SUITE(corrections)

BOOST_AUTO_TEST_CASE(geometric_changes_leave_the_rest_of_their_series) {
  constexpr double kRatio = 0.2;
  Corrections changes;
  BOOST_TEST(changes.error_after(0) == 0.0);
  for (int k = 0; k < 3; ++k) changes.add(std::pow(kRatio, k));
  for (const std::size_t j : {std::size_t{3}, std::size_t{5}}) {
    double rest = 0.0;
    for (std::size_t k = j; k < 60; ++k) rest += std::pow(kRatio, static_cast<double>(k));
    BOOST_TEST(changes.error_after(j) == rest, boost::test_tools::tolerance(1e-12));
  }
  // The error of an earlier iterate is the next change.
  BOOST_TEST(changes.error_after(1) == kRatio);
}

BOOST_AUTO_TEST_CASE(corrections_that_hardly_contract_are_the_error) {
  Corrections one;
  one.add(3.0);
  BOOST_TEST(one.error_after(1) == 3.0);
  BOOST_TEST(one.error_after(1, 0.2) == 0.75, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(one.error_after(2, 0.2) == 0.15, boost::test_tools::tolerance(1e-12));
  for (const double last : {2.4, 9.0}) {
    Corrections two = one;
    two.add(last);
    BOOST_TEST(two.error_after(2) == last);
  }
}

BOOST_AUTO_TEST_CASE(no_contraction_is_believed_that_may_be_chance) {
  Corrections changes;
  BOOST_TEST(changes.contraction() == 1.0);
  changes.add(1.0);
  changes.add(1e-3);
  BOOST_TEST(changes.contraction() == thresholds::best_contraction);
  changes.add(1.0);
  BOOST_TEST(changes.contraction() == 1.0);
}

BOOST_AUTO_TEST_SUITE_END()
