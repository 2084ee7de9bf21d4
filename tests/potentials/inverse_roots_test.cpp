#include "bie/kernels/inverse_roots.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <limits>
#include <random>

using namespace vehd;

BOOST_AUTO_TEST_SUITE(inverse_roots)

BOOST_AUTO_TEST_CASE_TEMPLATE(
    they_are_those_of_any_size_to_two_units_in_the_last_place, Count,
    decltype(std::tuple<std::integral_constant<std::size_t, 4>, std::integral_constant<std::size_t, 8>>())) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> logarithm(-600.0, 600.0);
  for (int trial = 0; trial < 20000; ++trial) {
    std::array<double, Count::value> squares;
    for (double& square : squares) square = std::exp(logarithm(random));
    std::array<double, Count::value> found = squares;
    invert_roots(found);
    for (std::size_t i = 0; i < Count::value; ++i) {
      const double error =
          std::abs(static_cast<double>(found[i] * std::sqrt(static_cast<long double>(squares[i])) - 1));
      BOOST_REQUIRE_LE(error, 2.0 * std::numeric_limits<double>::epsilon());
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
