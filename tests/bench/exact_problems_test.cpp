#include "bie/bench/exact_problems.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <set>
#include <vector>

using namespace vehd;

BOOST_AUTO_TEST_SUITE(equal_error)

BOOST_AUTO_TEST_CASE(degree_is_the_lowest_that_is_enough) {
  std::set<int> solved;
  const ExactProblem problem{"field", [&solved](int degree) {
                               solved.insert(degree);
                               return SolvedProblem{std::pow(10.0, -0.25 * degree), 1.0};
                             }};
  for (const auto& [error, degree] :
       {std::pair{1e-3, 12}, {0.9e-3, 13}, {1.1e-3, 12}, {1e-8, 32}, {0.2, 4}, {0.4, 4}}) {
    const auto found = degree_of_error(problem, error, 4, 32);
    BOOST_TEST_REQUIRE(found.has_value());
    BOOST_TEST(found->degree == degree, error);
    BOOST_TEST(found->error == std::pow(10.0, -0.25 * degree));
  }
  BOOST_TEST(!degree_of_error(problem, 0.9e-8, 4, 32).has_value());
  // No degree below the lowest or above the highest is solved.
  BOOST_TEST(*solved.begin() >= 4);
  BOOST_TEST(*solved.rbegin() == 32);
}

BOOST_AUTO_TEST_CASE(an_error_that_is_no_number_is_not_enough) {
  const ExactProblem problem{"field", [](int) { return SolvedProblem{std::nan(""), 1.0}; }};
  BOOST_TEST(!degree_of_error(problem, 1.0, 4, 8).has_value());
}

// Memory that is freed before the end counts as well.
BOOST_AUTO_TEST_CASE(memory_is_the_most_that_a_solution_holds) {
  constexpr std::size_t kNumbers = 4'000'000;
  const ExactProblem problem{"field", [](int degree) {
                               const std::vector<double> held(kNumbers * degree, 1.0);
                               return SolvedProblem{held.back(), 1.0};
                             }};
  const auto bytes = memory_of([&] { (void)problem.solve(2); });
  if (!bytes) return;
  BOOST_TEST(*bytes > 2 * 8 * 4'000'000 * 0.9);
  BOOST_TEST(*bytes < 2 * 8 * 4'000'000 * 1.3);
}

BOOST_AUTO_TEST_SUITE_END()
