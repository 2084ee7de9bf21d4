#include "bie/sphere/transform.hpp"

#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/sphere/rotation.hpp"
#include "tests/support/fields.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(transform)

BOOST_AUTO_TEST_CASE(round_trip_is_identity) {
  for (const int order : {4, 5, 16, 33, 64}) {
    for (const int grid_order : {order, 2 * order}) {
      const SphereTransform transform(order, make_grid(grid_order));
      const Matrix c = random_coefficients(order, 3, 7);
      BOOST_TEST(max_difference(transform.analyze(transform.synthesize(c)), c) < 2e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(low_harmonics_are_the_written_formulas) {
  const SphereTransform transform(4, make_grid(6));
  const SphereGrid& grid = transform.grid();
  const double pi = std::numbers::pi;
  for (int j = 0; j < grid.n_theta; ++j) {
    for (int k = 0; k < grid.n_phi; ++k) {
      const double x = std::sin(grid.theta[j]) * std::cos(grid.phi[k]);
      const double y = std::sin(grid.theta[j]) * std::sin(grid.phi[k]);
      const double z = std::cos(grid.theta[j]);
      const auto value = [&](int n, int m) {
        Matrix c = Matrix::Zero(n_coefficients(4), 1);
        c(coefficient_index(n, m), 0) = 1.0;
        return transform.synthesize(c)(j * grid.n_phi + k, 0);
      };
      BOOST_TEST(value(0, 0) == std::sqrt(1 / (4 * pi)), boost::test_tools::tolerance(1e-13));
      BOOST_TEST(std::abs(value(1, 0) - std::sqrt(3 / (4 * pi)) * z) < 1e-14);
      BOOST_TEST(std::abs(value(1, 1) - std::sqrt(3 / (4 * pi)) * x) < 1e-14);
      BOOST_TEST(std::abs(value(1, -1) - std::sqrt(3 / (4 * pi)) * y) < 1e-14);
      BOOST_TEST(std::abs(value(2, -2) - std::sqrt(15 / (4 * pi)) * x * y) < 1e-14);
      BOOST_TEST(std::abs(value(3, 2) - std::sqrt(105 / (16 * pi)) * z * (x * x - y * y)) < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_agree_with_central_differences_and_laplacian) {
  const int order = 9;
  const SphereTransform transform(order, make_grid(order));
  const Matrix c = random_coefficients(order, 1, 3);
  const SphereDerivatives d = transform.synthesize_hessian(c);
  // Not captured directly: clang 14 does not support capturing structured bindings.
  const auto [theta, phi] = grid_angles(transform.grid());
  const double h = 1e-4;
  const auto at = [&, &theta = theta, &phi = phi](double dt, double dp) -> Eigen::ArrayXd {
    return evaluate_harmonics(c, theta.array() + dt, phi.array() + dp).col(0).array();
  };
  const Eigen::ArrayXd sine = theta.array().sin();
  const Eigen::ArrayXd cotangent = theta.array().cos() / sine;
  const Eigen::ArrayXd f_t = (at(h, 0) - at(-h, 0)) / (2 * h);
  const Eigen::ArrayXd f_p = (at(0, h) - at(0, -h)) / (2 * h);
  const Eigen::ArrayXd f_tt = (at(h, 0) - 2 * at(0, 0) + at(-h, 0)) / (h * h);
  const Eigen::ArrayXd f_pp = (at(0, h) - 2 * at(0, 0) + at(0, -h)) / (h * h);
  const Eigen::ArrayXd f_tp = (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * h * h);
  BOOST_TEST((d.value.col(0).array() - at(0, 0)).abs().maxCoeff() < 1e-12);
  BOOST_TEST((d.d1.col(0).array() - f_t).abs().maxCoeff() < 1e-4);
  BOOST_TEST((d.d2.col(0).array() - f_p / sine).abs().maxCoeff() < 1e-4);
  BOOST_TEST((d.d11.col(0).array() - f_tt).abs().maxCoeff() < 1e-3);
  BOOST_TEST((d.d12.col(0).array() - (f_tp - cotangent * f_p) / sine).abs().maxCoeff() < 1e-3);
  BOOST_TEST((d.d22.col(0).array() - (f_pp / sine.square() + cotangent * f_t)).abs().maxCoeff() < 1e-3);
}

BOOST_AUTO_TEST_CASE(some_derivatives_are_those_of_all_of_them) {
  for (const int order : {4, 9, 16}) {
    const SphereTransform transform(order, make_grid(2 * order));
    const Matrix c = random_coefficients(order, 3, 11);
    const SphereDerivatives all = transform.synthesize_hessian(c);
    const SphereDerivatives without_value = transform.synthesize_derivatives(c);
    BOOST_TEST(without_value.value.size() == 0);
    for (Matrix SphereDerivatives::*kind : {&SphereDerivatives::d1, &SphereDerivatives::d2, &SphereDerivatives::d11,
                                            &SphereDerivatives::d12, &SphereDerivatives::d22}) {
      BOOST_TEST(max_difference(without_value.*kind, all.*kind) == 0.0);
    }
    const SphereDerivatives first = transform.synthesize_first_derivatives(c);
    BOOST_TEST(first.value.size() + first.d11.size() == 0);
    BOOST_TEST(max_difference(first.d1, all.d1) == 0.0);
    BOOST_TEST(max_difference(first.d2, all.d2) == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(azimuthal_order_leaves_higher_harmonics_out) {
  const int order = 9;
  const auto [theta, phi] = grid_angles(make_grid(7));
  const Matrix all = random_coefficients(order, 2, 5);
  for (const int highest : {0, 1, 4, order}) {
    Matrix low = all;
    for (int n = 0; n <= order; ++n) {
      for (int m = highest + 1; m <= n; ++m) {
        low.row(coefficient_index(n, m)).setZero();
        low.row(coefficient_index(n, -m)).setZero();
      }
    }
    BOOST_TEST(max_difference(evaluate_harmonics(all, theta, phi, highest), evaluate_harmonics(low, theta, phi)) ==
               0.0);
  }
}

BOOST_AUTO_TEST_CASE(gauss_rule_integrates_polynomials) {
  for (const int n : {1, 2, 5, 17, 65, 131}) {
    const GaussLegendre rule = gauss_legendre(n);
    for (int power = 0; power <= 2 * n - 1; power += 2) {
      const double integral = rule.weights.dot(Vector(rule.nodes.array().pow(power)));
      BOOST_TEST(std::abs(integral - 2.0 / (power + 1)) < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(rotation_of_coefficients_is_rotation_of_points) {
  const int order = 12;
  const Matrix c = random_coefficients(order, 1, 11);
  for (const double beta : {0.013, 0.9, 2.2, 3.1}) {
    const RotationY rotation = rotation_y(order, beta);
    Matrix rotated = Matrix::Zero(c.rows(), 1);
    for (int n = 0; n <= order; ++n) {
      for (int after = 0; after <= n; ++after) {
        for (int before = 0; before <= n; ++before) {
          rotated(coefficient_index(n, after), 0) +=
              rotation.cosine[n](after, before) * c(coefficient_index(n, before), 0);
          if (after > 0 && before > 0) {
            rotated(coefficient_index(n, -after), 0) +=
                rotation.sine[n](after - 1, before - 1) * c(coefficient_index(n, -before), 0);
          }
        }
      }
    }
    const auto [theta, phi] = grid_angles(make_grid(7));
    const Eigen::ArrayXd x = theta.array().sin() * phi.array().cos();
    const Eigen::ArrayXd y = theta.array().sin() * phi.array().sin();
    const Eigen::ArrayXd z = theta.array().cos();
    const Eigen::ArrayXd x_new = std::cos(beta) * x + std::sin(beta) * z;
    const Eigen::ArrayXd z_new = -std::sin(beta) * x + std::cos(beta) * z;
    Vector phi_new(phi.size());
    for (Index i = 0; i < phi.size(); ++i) phi_new[i] = std::atan2(y[i], x_new[i]);
    const Matrix expected = evaluate_harmonics(c, z_new.max(-1.0).min(1.0).acos(), phi_new);
    BOOST_TEST(max_difference(evaluate_harmonics(rotated, theta, phi), expected) < 1e-11);
  }
}

BOOST_AUTO_TEST_CASE(rotation_blocks_are_orthogonal_at_high_order) {
  const RotationY rotation = rotation_y(64, 3.05);
  for (const int n : {1, 17, 40, 64}) {
    const Matrix& block = rotation.cosine[n];
    BOOST_TEST(max_difference(block * block.transpose(), Matrix::Identity(n + 1, n + 1)) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(longitudes_of_fast_transforms_are_the_next_without_a_large_prime) {
  for (const auto& [least, step, expected] :
       {std::array{66, 2, 66}, {34, 2, 36}, {82, 2, 84}, {74, 2, 78}, {50, 6, 54}}) {
    BOOST_TEST(fast_longitudes(least, step) == expected);
  }
  // If the step itself has a large prime factor, every multiple has it.
  BOOST_TEST(fast_longitudes(40, 34) == 68);
}

BOOST_AUTO_TEST_CASE(values_in_directions_are_those_at_their_angles) {
  const Matrix coefficients = random_coefficients(7, 2, 19);
  const Vector theta{{0.0, 0.3, 1.2, 2.9, std::numbers::pi}}, phi{{0.0, 5.9, 2.2, 0.4, 0.0}};
  Matrix directions(theta.size(), 3);
  directions << theta.array().sin() * phi.array().cos(), theta.array().sin() * phi.array().sin(), theta.array().cos();
  BOOST_TEST(max_difference(evaluate_harmonics(coefficients, Matrix(3.0 * directions), 5),
                            evaluate_harmonics(coefficients, theta, phi, 5)) < 1e-13);
}

BOOST_AUTO_TEST_SUITE_END()
