#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/stepping/time/time_rule.hpp"

using namespace vehd;

BOOST_AUTO_TEST_SUITE(time_rules)

BOOST_AUTO_TEST_CASE(weights_integrate_polynomials_from_the_start_to_every_node) {
  for (int order = 2; order <= highest_time_order; ++order) {
    const TimeRule rule = time_rule(order);
    const int n_nodes = static_cast<int>(rule.nodes.size());
    BOOST_TEST(rule.nodes.back() == 1.0);
    for (int degree = 0; degree < n_nodes; ++degree) {
      for (int m = 0; m < n_nodes; ++m) {
        double sum = degree == 0 ? rule.weights(m, 0) : 0.0;
        for (int j = 0; j < n_nodes; ++j) sum += rule.weights(m, j + 1) * std::pow(rule.nodes[j], degree);
        BOOST_TEST(std::abs(sum - std::pow(rule.nodes[m], degree + 1) / (degree + 1)) < 1e-14, order << " " << m);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(weights_integrate_polynomials_through_all_points_to_any_time) {
  for (int order = 2; order <= highest_time_order; ++order) {
    const TimeRule rule = time_rule(order);
    const int n_nodes = static_cast<int>(rule.nodes.size());
    for (const double c : {0.0, 0.1, 0.37, 0.8, 1.0}) {
      const Vector weights = integration_weights(points_of(rule), c);
      BOOST_TEST_REQUIRE(weights.size() == n_nodes + 1);
      for (int degree = 0; degree <= n_nodes; ++degree) {
        double sum = degree == 0 ? weights[0] : 0.0;
        for (int j = 0; j < n_nodes; ++j) sum += weights[j + 1] * std::pow(rule.nodes[j], degree);
        BOOST_TEST(std::abs(sum - std::pow(c, degree + 1) / (degree + 1)) < 1e-13, order << " " << c << " " << degree);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(weights_from_zero_continue_polynomials_that_vanish_there) {
  const Vector places{{-1.0, -0.8, -0.3}};
  for (const double x : {-0.5, 0.4, 1.0, 2.0}) {
    const Vector weights = weights_from_zero(places, x);
    for (int degree = 1; degree < 4; ++degree) {
      const double value = weights.dot(Vector(places.array().pow(degree)));
      BOOST_TEST(std::abs(value - std::pow(x, degree)) < 1e-12, x << " " << degree);
    }
  }
}

BOOST_AUTO_TEST_CASE(integration_errors_of_the_first_inexact_powers_are_right) {
  const std::vector<double> points{0.0, 0.3, 0.55, 1.0};
  for (const double c : {0.2, 0.7, 1.0}) {
    for (int power = 0; power < 4; ++power) BOOST_TEST(std::abs(integration_error(points, c, power)) < 1e-14);
    const Vector weights = integration_weights(points, c);
    double factorial = 6.0;
    for (const int power : {4, 5}) {
      factorial *= power;
      double exact = std::pow(c, power + 1) / (power + 1.0);
      for (Index j = 1; j < 4; ++j) exact -= weights[j] * std::pow(points[static_cast<std::size_t>(j)], power);
      BOOST_TEST(integration_error(points, c, power) == exact / factorial, boost::test_tools::tolerance(1e-9));
    }
  }
  // Radau IIA with three nodes: s/2 ((s - 1)!)⁴ / ((2s - 1)!)³ for s = 3 points.
  BOOST_TEST(integration_error(points_of(time_rule(5)), 1.0, 5) == -1.0 / 72000.0, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(derivatives_of_polynomials_are_exact_at_the_mean_of_the_points) {
  const std::vector<double> points{0.0, 0.2, 0.6, 1.0};
  constexpr double kMean = 0.45;
  Vector values(4);
  for (Index j = 0; j < 4; ++j) {
    const double x = points[static_cast<std::size_t>(j)];
    values[j] = 2.0 - x + 3.0 * x * x - 5.0 * x * x * x;
  }
  BOOST_TEST(std::abs(derivative_weights(points, 1).dot(values) - (-1.0 + 6.0 * kMean - 15.0 * kMean * kMean)) < 1e-12);
  BOOST_TEST(std::abs(derivative_weights(points, 2).dot(values) - (6.0 - 30.0 * kMean)) < 1e-12);
  BOOST_TEST(std::abs(derivative_weights(points, 3).dot(values) + 30.0) < 1e-12);
}

BOOST_AUTO_TEST_CASE(whole_step_is_integrated_to_the_order_of_radau) {
  for (const int order : {3, 4, 5}) {
    const TimeRule rule = time_rule(order);
    const int n_nodes = static_cast<int>(rule.nodes.size());
    for (int degree = 0; degree <= 2 * n_nodes - 2; ++degree) {
      double sum = 0.0;
      for (int j = 0; j < n_nodes; ++j) sum += rule.weights(n_nodes - 1, j + 1) * std::pow(rule.nodes[j], degree);
      BOOST_TEST(std::abs(sum - 1.0 / (degree + 1)) < 1e-14, order << " " << degree);
    }
  }
}

BOOST_AUTO_TEST_CASE(as_many_sweeps_as_nodes_solve_an_infinitely_stiff_equation) {
  for (const int order : {3, 4, 5}) {
    const TimeRule rule = time_rule(order);
    const Index n_nodes = static_cast<Index>(rule.nodes.size());
    const Vector sizes = Eigen::Map<const Vector>(rule.implicit_sizes.data(), n_nodes);
    const Matrix error =
        Matrix::Identity(n_nodes, n_nodes) - sizes.cwiseInverse().asDiagonal() * rule.weights.rightCols(n_nodes);
    Matrix power = Matrix::Identity(n_nodes, n_nodes);
    for (Index sweep = 0; sweep < n_nodes; ++sweep) power = power * error;
    BOOST_TEST(power.cwiseAbs().maxCoeff() < 1e-13);
    BOOST_TEST(error.cwiseAbs().maxCoeff() > 0.1);
  }
}

BOOST_AUTO_TEST_SUITE_END()
