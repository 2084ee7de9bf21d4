#include "bie/fit/least_squares.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/fit/noise.hpp"
#include "bie/support/errors.hpp"
#include "tests/fit/linear_model.hpp"

BOOST_AUTO_TEST_SUITE(least_squares, *boost::unit_test::label("once"))

namespace {

using vehd::Index;
using vehd::Vector;
using vehd::testing::problem_of;

/// Decay with amplitude, rate and limit, given by their logarithms.
Vector relaxation(const Vector& p) {
  Vector values(30);
  for (Index i = 0; i < 30; ++i) {
    values[i] = std::exp(p[2]) + std::exp(p[0]) * std::exp(-std::exp(p[1]) * 0.1 * static_cast<double>(i));
  }
  return values;
}

}  // namespace

BOOST_AUTO_TEST_CASE(three_parameters_need_at_most_sixty_evaluations) {
  const Vector truth{{0.2, 0.5, -1.0}};
  for (int seed = 1; seed <= 20; ++seed) {
    vehd::LeastSquares problem = problem_of(relaxation, truth, 0.02);
    problem.start = truth.array() + Eigen::Array3d(1.5, -1.5, 1.5);
    vehd::NormalNumbers normal(static_cast<std::uint64_t>(seed));
    for (double& value : problem.data) value += 0.02 * normal();
    int n_told = 0;
    problem.report_progress = [&](int n_evaluations, double) { n_told = n_evaluations; };
    const vehd::Minimum minimum = vehd::minimum_of(problem);
    BOOST_TEST(minimum.converged);
    BOOST_TEST(minimum.n_evaluations <= 60);
    BOOST_TEST(minimum.n_evaluations == n_told);
    const vehd::Vector miss = minimum.jacobian * (minimum.point - truth);
    // χ² of three parameters exceeds 16.3 once in a thousand cases.
    BOOST_TEST(miss.squaredNorm() < 16.3);
  }
}

BOOST_AUTO_TEST_CASE(a_minimum_beyond_an_interval_is_looked_for_at_its_end) {
  vehd::LeastSquares problem = problem_of(relaxation, Vector{{0.2, 0.5, -1.0}}, 0.02);
  problem.lower[1] = 0.7;
  problem.start[1] = 1.0;
  const vehd::Minimum minimum = vehd::minimum_of(problem);
  BOOST_TEST(minimum.point[1] >= 0.7);
  BOOST_TEST(minimum.point[1] < 0.75);
}

BOOST_AUTO_TEST_CASE(points_without_a_model_are_walked_around_and_a_start_without_one_is_refused) {
  vehd::LeastSquares problem = problem_of(relaxation, Vector{{0.2, 0.5, -1.0}}, 0.02);
  const auto everywhere = problem.model;
  const auto unless = [&](double limit) {
    return [=](const std::vector<Vector>& points) {
      std::vector<vehd::Prediction> predictions = everywhere(points);
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i][1] > limit) predictions[i] = {std::nullopt, "cannot step"};
      }
      return predictions;
    };
  };
  problem.model = unless(problem.start[1] + 0.05);
  BOOST_TEST(vehd::minimum_of(problem).chi2() < 0.01);
  problem.model = unless(problem.start[1] - 0.05);
  BOOST_CHECK_EXCEPTION(vehd::minimum_of(problem), vehd::InputError, [](const auto& error) {
    return std::string(error.what()) == "the model has no value at the start: cannot step";
  });
}

BOOST_AUTO_TEST_SUITE_END()
