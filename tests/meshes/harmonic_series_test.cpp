#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/meshes/shapes.hpp"

using namespace vehd::meshes;
using namespace vehd::meshes::testing;

namespace {

constexpr double kPi = std::numbers::pi;

int row(int n, int m) { return n * n + n + m; }

/// Arbitrary coefficients of decreasing size.
Eigen::MatrixXd some_coefficients(int degree, int n_columns) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd result((degree + 1) * (degree + 1), n_columns);
  for (int n = 0; n <= degree; ++n) {
    for (int m = -n; m <= n; ++m) {
      for (int c = 0; c < n_columns; ++c) result(row(n, m), c) = uniform(random) / (1.0 + n);
    }
  }
  return result;
}

std::vector<Point> some_directions() {
  return {direction_of(0.0, 0.0), direction_of(kPi, 0.0), direction_of(0.9, 2.1), direction_of(2.3, -1.2),
          direction_of(1e-9, 0.4)};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(harmonic_series)

BOOST_AUTO_TEST_CASE(low_harmonics_are_the_written_formulas) {
  const HarmonicSeries all = all_harmonics(3);
  for (const auto& [theta, phi] : {std::pair{0.7, 0.3}, std::pair{1.9, 4.0}, std::pair{2.8, -1.0}}) {
    const Eigen::VectorXd y = all.value(direction_of(theta, phi));
    const double s = std::sin(theta);
    const double c = std::cos(theta);
    BOOST_TEST(std::abs(y[row(0, 0)] - std::sqrt(1.0 / (4.0 * kPi))) < 1e-14);
    BOOST_TEST(std::abs(y[row(1, 0)] - std::sqrt(3.0 / (4.0 * kPi)) * c) < 1e-14);
    BOOST_TEST(std::abs(y[row(1, 1)] - std::sqrt(3.0 / (4.0 * kPi)) * s * std::cos(phi)) < 1e-14);
    BOOST_TEST(std::abs(y[row(1, -1)] - std::sqrt(3.0 / (4.0 * kPi)) * s * std::sin(phi)) < 1e-14);
    BOOST_TEST(std::abs(y[row(2, 0)] - std::sqrt(5.0 / (16.0 * kPi)) * (3.0 * c * c - 1.0)) < 1e-14);
    BOOST_TEST(std::abs(y[row(2, -1)] - std::sqrt(15.0 / (4.0 * kPi)) * s * c * std::sin(phi)) < 1e-14);
    BOOST_TEST(std::abs(y[row(3, 2)] - std::sqrt(105.0 / (16.0 * kPi)) * s * s * c * std::cos(2.0 * phi)) < 1e-14);
    BOOST_TEST(std::abs(y[row(3, -3)] - std::sqrt(35.0 / (32.0 * kPi)) * s * s * s * std::sin(3.0 * phi)) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(harmonics_are_orthonormal) {
  constexpr int kDegree = 12;
  const HarmonicSeries all = all_harmonics(kDegree);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(all.n_columns(), all.n_columns());
  for_each_sphere_point(kDegree + 1, [&](const Point& direction, double weight) {
    const Eigen::VectorXd y = all.value(direction);
    gram += weight * y * y.transpose();
  });
  BOOST_TEST((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff() < 1e-13);
}

BOOST_AUTO_TEST_CASE(squares_of_one_degree_sum_to_a_constant_up_to_degree_64) {
  // Σ_m Y_{n,m}² = (2n + 1)/4π in every direction: reveals any loss of digits at high degree.
  const HarmonicSeries all = all_harmonics(64);
  for (const Point& direction : some_directions()) {
    const Eigen::VectorXd y = all.value(direction);
    for (const int n : {16, 40, 64}) {
      const double sum = y.segment(row(n, -n), 2 * n + 1).squaredNorm();
      BOOST_TEST(std::abs(sum * 4.0 * kPi / (2.0 * n + 1.0) - 1.0) < 1e-12);
    }
  }
}

BOOST_AUTO_TEST_CASE(many_points_at_once_are_the_points_one_by_one) {
  const HarmonicSeries series(some_coefficients(17, 5));
  Eigen::Matrix3Xd directions(3, 21);
  for (int i = 0; i < 21; ++i) directions.col(i) = direction_of(0.15 * i, 1.7 * i);
  const Eigen::MatrixXd together = series.values(directions);
  for (int i = 0; i < 21; ++i) {
    BOOST_TEST((together.col(i) - series.value(directions.col(i))).cwiseAbs().maxCoeff() < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(gradient_is_tangential_and_agrees_with_differences_at_the_poles_too) {
  const HarmonicSeries series(some_coefficients(12, 3));
  for (const Point& direction : some_directions()) {
    Eigen::VectorXd value;
    Eigen::MatrixXd gradient;
    series.value_and_gradient(direction, value, gradient);
    BOOST_TEST((value - series.value(direction)).cwiseAbs().maxCoeff() < 1e-13);
    BOOST_TEST((gradient * direction).cwiseAbs().maxCoeff() < 1e-12);
    const Point first = direction.unitOrthogonal();
    for (const Point& tangent : {first, Point(direction.cross(first))}) {
      constexpr double kStep = 1e-5;
      const Eigen::VectorXd ahead = series.value((direction + kStep * tangent).normalized());
      const Eigen::VectorXd behind = series.value((direction - kStep * tangent).normalized());
      BOOST_TEST((gradient * tangent - (ahead - behind) / (2.0 * kStep)).cwiseAbs().maxCoeff() < 1e-7);
    }
  }
}

BOOST_AUTO_TEST_CASE(coefficients_that_fill_no_degree_are_refused) {
  BOOST_CHECK_THROW(HarmonicSeries(Eigen::MatrixXd::Zero(10, 3)), std::invalid_argument);
  BOOST_CHECK_THROW(HarmonicSeries(Eigen::MatrixXd::Zero(0, 3)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
