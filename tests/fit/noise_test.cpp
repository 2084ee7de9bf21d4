#include "bie/fit/noise.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

BOOST_AUTO_TEST_SUITE(noise, *boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(numbers_are_normal_and_independent) {
  constexpr int n = 200000;
  vehd::NormalNumbers normal(3);
  double mean = 0.0, variance = 0.0, fourth = 0.0, next = 0.0, before = 0.0;
  for (int i = 0; i < n; ++i) {
    const double number = normal();
    mean += number / n;
    variance += number * number / n;
    fourth += std::pow(number, 4) / n;
    next += number * before / n;
    before = number;
  }
  // Four standard errors of each average.
  const double error = 4.0 / std::sqrt(n);
  BOOST_TEST(std::abs(mean) < error);
  BOOST_TEST(std::abs(variance - 1.0) < std::sqrt(2.0) * error);
  BOOST_TEST(std::abs(fourth - 3.0) < std::sqrt(96.0) * error);
  BOOST_TEST(std::abs(next) < error);
}

BOOST_AUTO_TEST_CASE(a_seed_gives_the_same_numbers_and_another_one_others) {
  vehd::NormalNumbers one(11), same(11), other(12);
  const double first = one();
  BOOST_TEST(first == same());
  BOOST_TEST(first != other());
}

BOOST_AUTO_TEST_CASE(numbers_follow_from_the_generator_of_the_standard) {
  std::mt19937_64 generator(5);
  const double radius = (static_cast<double>(generator() >> 11) + 1.0) * 0x1p-53;
  const double turn = static_cast<double>(generator() >> 11) * 0x1p-53;
  vehd::NormalNumbers normal(5);
  BOOST_TEST(normal() == std::sqrt(-2.0 * std::log(radius)) * std::cos(2.0 * std::numbers::pi * turn),
             boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_SUITE_END()
