#include "bie/fit/statistics.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/fit/noise.hpp"
#include "tests/fit/linear_model.hpp"

BOOST_AUTO_TEST_SUITE(fit_statistics, *boost::unit_test::label("once"))

namespace {

using vehd::Index;
using vehd::Matrix;
using vehd::Vector;
using vehd::testing::problem_of;

constexpr Index n_data = 20;

double abscissa(Index i) { return 0.1 * static_cast<double>(i); }

/// p0 + p1 x
Vector straight_line(const Vector& p) {
  Vector values(n_data);
  for (Index i = 0; i < n_data; ++i) values[i] = p[0] + p[1] * abscissa(i);
  return values;
}

/// A decay with the rate exp(p0 − p1): bending relaxation depends on κ_B and μ only through this ratio.
Vector decay_by_ratio(const Vector& p) {
  Vector values(n_data);
  for (Index i = 0; i < n_data; ++i) values[i] = std::exp(-std::exp(p[0] - p[1]) * abscissa(i));
  return values;
}

/// A model plus the run's error, up to a tenth of a deviation and different at every point.
template <typename Model>
auto with_run_error(const Model& model, double error) {
  return [model, error](const Vector& p) {
    vehd::NormalNumbers normal(std::hash<double>{}(p.sum() + 3.0 * p[0]));
    Vector values = model(p);
    for (double& value : values) value += 0.3 * error * normal();
    return values;
  };
}

vehd::Statistics statistics(const vehd::LeastSquares& problem) {
  vehd::Minimum minimum = vehd::minimum_of(problem);
  BOOST_TEST(minimum.converged);
  std::vector<vehd::Combination> combinations = vehd::undetermined_combinations(problem, minimum);
  return vehd::statistics_of(minimum.jacobian, std::move(combinations));
}

}  // namespace

BOOST_AUTO_TEST_CASE(those_of_a_straight_line_are_the_closed_ones) {
  vehd::LeastSquares problem = problem_of(straight_line, Vector{{1.0, 2.0}}, 1.0);
  double s = 0.0, sx = 0.0, sxx = 0.0, sy = 0.0, sxy = 0.0;
  vehd::NormalNumbers normal(7);
  for (Index i = 0; i < n_data; ++i) {
    problem.deviations[i] = 0.05 * (1.0 + 0.1 * static_cast<double>(i));
    problem.data[i] += problem.deviations[i] * normal();
    const double weight = 1.0 / (problem.deviations[i] * problem.deviations[i]), x = abscissa(i), y = problem.data[i];
    s += weight;
    sx += weight * x;
    sxx += weight * x * x;
    sy += weight * y;
    sxy += weight * x * y;
  }
  const double determinant = s * sxx - sx * sx;
  const vehd::Minimum minimum = vehd::minimum_of(problem);
  const vehd::Statistics result = vehd::statistics_of(minimum.jacobian, {});
  BOOST_TEST(result.covariance(0, 0) == sxx / determinant, boost::test_tools::tolerance(1e-8));
  BOOST_TEST(result.covariance(1, 1) == s / determinant, boost::test_tools::tolerance(1e-8));
  BOOST_TEST(result.covariance(0, 1) == -sx / determinant, boost::test_tools::tolerance(1e-8));
  BOOST_TEST(result.correlation(1, 0) == -sx / std::sqrt(s * sxx), boost::test_tools::tolerance(1e-8));
  BOOST_TEST(result.errors[1] == std::sqrt(s / determinant), boost::test_tools::tolerance(1e-8));
  // The search ends within a tenth of a standard error.
  const Vector exact{{(sxx * sy - sx * sxy) / determinant, (s * sxy - sx * sy) / determinant}};
  const Vector miss = minimum.point - exact;
  BOOST_TEST(miss.dot(result.covariance.inverse() * miss) < 0.01);
  BOOST_TEST(minimum.chi2() <
             (problem.data - straight_line(exact)).cwiseQuotient(problem.deviations).squaredNorm() + 0.01);
}

BOOST_AUTO_TEST_CASE(a_ratio_leaves_both_of_its_parts_undetermined) {
  for (const double run_error : {0.0, 0.1}) {
    const double deviation = 0.01;
    vehd::LeastSquares problem =
        problem_of(with_run_error(decay_by_ratio, run_error * deviation), Vector{{0.3, 0.1}}, deviation);
    problem.run_error = 0.1;
    const vehd::Statistics result = statistics(problem);
    BOOST_TEST_REQUIRE(result.undetermined.size() == 1u);
    const Vector& direction = result.undetermined.front().direction;
    BOOST_TEST(std::abs(direction[0] - direction[1]) < 0.05);
    BOOST_TEST(!std::isfinite(result.errors[0]));
    BOOST_TEST(!std::isfinite(result.errors[1]));
    BOOST_TEST(std::isnan(result.correlation(0, 1)));
  }
}

BOOST_AUTO_TEST_CASE(a_ratio_in_a_corner_of_the_intervals_of_its_parts_gives_neither_an_interval) {
  // The data have p0 - p1 = 0.2, the intervals allow 0.5 or more: at the least, neither sign of (1, 1) stays inside.
  vehd::LeastSquares problem = problem_of(decay_by_ratio, Vector{{0.3, 0.1}}, 0.01);
  problem.lower = Vector{{1.0, -2.0}};
  problem.upper = Vector{{3.0, 0.5}};
  problem.start = Vector{{1.5, 0.0}};
  vehd::Minimum minimum = vehd::minimum_of(problem);
  BOOST_TEST(minimum.at_end == (std::vector<Index>{0, 1}), boost::test_tools::per_element());
  BOOST_TEST((minimum.point - Vector{{1.0, 0.5}}).norm() < 0.01);
  for (const Vector& point : {minimum.point, Vector{{1.0, 0.5}}}) {
    minimum.point = point;
    const vehd::Statistics result =
        vehd::statistics_of(minimum.jacobian, vehd::undetermined_combinations(problem, minimum));
    BOOST_TEST(result.undetermined.size() == 1u);
    for (const double error : result.errors) BOOST_TEST(std::isinf(error));
  }
}

BOOST_AUTO_TEST_CASE(a_parameter_at_an_end_of_its_interval_has_no_error) {
  vehd::LeastSquares problem = problem_of(straight_line, Vector{{1.0, 2.0}}, 0.01);
  BOOST_TEST(vehd::minimum_of(problem).at_end.empty());
  problem.upper[1] = 1.9;
  problem.start[1] = 1.5;
  const vehd::Minimum minimum = vehd::minimum_of(problem);
  BOOST_TEST(minimum.at_end == std::vector<Index>{1}, boost::test_tools::per_element());
  const vehd::Statistics result = vehd::statistics_of(minimum.jacobian, {}, minimum.at_end);
  BOOST_TEST(std::isfinite(result.errors[0]));
  BOOST_TEST(std::isinf(result.errors[1]));
  BOOST_TEST(std::isnan(result.correlation(0, 1)));
}

BOOST_AUTO_TEST_CASE(a_determined_key_beside_an_undetermined_pair_keeps_its_interval) {
  const auto model = [](const Vector& p) {
    Vector values(2 * n_data);
    values << decay_by_ratio(p), straight_line(Vector{{p[2], 1.0}});
    return values;
  };
  const double deviation = 0.01;
  const vehd::Statistics result = statistics(problem_of(model, Vector{{0.3, 0.1, 0.5}}, deviation));
  BOOST_TEST(!std::isfinite(result.errors[0]));
  BOOST_TEST(!std::isfinite(result.errors[1]));
  BOOST_TEST(result.errors[2] == deviation / std::sqrt(n_data), boost::test_tools::tolerance(1e-6));
  BOOST_TEST(result.correlation(2, 2) == 1.0);
}

BOOST_AUTO_TEST_CASE(strong_correlation_is_not_taken_for_an_undetermined_combination) {
  // Rate and amplitude of a decay of which only the beginning is observed.
  const auto model = [](const Vector& p) {
    Vector values(n_data);
    for (Index i = 0; i < n_data; ++i) {
      values[i] = std::exp(p[1]) * (1.0 - std::exp(-std::exp(p[0]) * 0.15 * abscissa(i)));
    }
    return values;
  };
  const vehd::Statistics result = statistics(problem_of(model, Vector{{0.0, 0.0}}, 1e-4));
  BOOST_TEST(result.undetermined.empty());
  BOOST_TEST(result.correlation(0, 1) < -0.99);
  BOOST_TEST(result.errors[0] < 0.1);
}

BOOST_AUTO_TEST_CASE(a_parameter_without_any_effect_is_undetermined_alone) {
  const auto model = [](const Vector& p) { return straight_line(Vector{{p[0], p[1]}}); };
  const vehd::Statistics result = statistics(problem_of(model, Vector{{1.0, 2.0, 0.0}}, 0.01));
  BOOST_TEST_REQUIRE(result.undetermined.size() == 1u);
  BOOST_TEST(std::abs(result.undetermined.front().direction[2]) == 1.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::isfinite(result.errors[0]));
  BOOST_TEST(std::isfinite(result.errors[1]));
}

BOOST_AUTO_TEST_SUITE_END()
