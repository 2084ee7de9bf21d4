#include "bie/bench/exact_problems.hpp"

#include <boost/test/unit_test.hpp>
#include <vector>

using namespace vehd;

BOOST_AUTO_TEST_SUITE(exact_problems)

// Memory that is freed before the end counts as well.
BOOST_AUTO_TEST_CASE(memory_is_the_most_that_a_solution_holds) {
  constexpr std::size_t kNumbers = 8'000'000;
  double last = 0.0;
  const auto bytes = memory_of([&last] {
    const std::vector<double> held(kNumbers, 1.0);
    last = held.back();
  });
  BOOST_TEST(last == 1.0);
  if (!bytes) return;
  BOOST_TEST(*bytes > 8 * 0.9 * kNumbers);
  BOOST_TEST(*bytes < 8 * 1.3 * kNumbers);
}

BOOST_AUTO_TEST_SUITE_END()
