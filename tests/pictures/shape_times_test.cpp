#include "bie/pictures/shape_times.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

using namespace vehd;

namespace {

/// n times and a shape that is described by one number.
struct Course {
  std::vector<double> times;
  Matrix rows;

  template <typename Shape>
  Course(int n, const Shape& shape) : rows(n, 1) {
    for (int i = 0; i < n; ++i) {
      times.push_back(0.1 * i);
      rows(i, 0) = shape(times.back());
    }
  }
  [[nodiscard]] std::vector<std::size_t> chosen(std::size_t most) const { return spread_by_change(times, rows, most); }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(shape_times)

BOOST_AUTO_TEST_CASE(times_ascend_from_the_first_to_the_last) {
  for (const int n : {1, 2, 3, 5, 6, 7, 200}) {
    for (std::size_t most = 1; most <= 6; ++most) {
      for (const double rate : {0.0, 1e-9, 0.3, 40.0}) {
        const Course course(n, [&](double t) { return 1.0 + std::tanh(rate * (t - 3.0)); });
        const std::vector<std::size_t> chosen = course.chosen(most);
        BOOST_TEST(chosen.size() <= most);
        BOOST_TEST(chosen.size() <= static_cast<std::size_t>(n));
        BOOST_TEST(chosen.front() == 0u);
        if (most > 1) BOOST_TEST(chosen.back() == static_cast<std::size_t>(n - 1));
        BOOST_TEST((std::ranges::adjacent_find(chosen, std::greater_equal<>()) == chosen.end()));
        if (n >= 200 && most == 6) BOOST_TEST(chosen.size() == 6u);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(they_lie_where_the_shape_changes) {
  const Course sudden(201, [](double t) { return 1.0 + 0.5 * std::tanh(4.0 * (t - 10.0)); });
  const auto chosen = sudden.chosen(6);
  // Four of the six times lie within the change, which takes a twentieth of the time.
  BOOST_TEST(std::ranges::count_if(chosen, [](std::size_t i) { return std::abs(0.1 * double(i) - 10.0) < 1.0; }) == 4);
  const Course steady(201, [](double t) { return 1.0 + t; });
  BOOST_TEST(steady.chosen(5) == (std::vector<std::size_t>{0, 50, 100, 150, 200}));
  const Course still(201, [](double) { return 1.0; });
  BOOST_TEST(still.chosen(5) == (std::vector<std::size_t>{0, 50, 100, 150, 200}));
}

BOOST_AUTO_TEST_SUITE_END()
