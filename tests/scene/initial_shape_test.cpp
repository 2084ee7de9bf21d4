#include "bie/scene/initial_shape.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "tests/scene/scene_text.hpp"

namespace {

using vehd::Matrix;
using vehd::Vector;
using vehd::Vector3;

const Vector theta{{0.0, 0.4, 1.3, 2.2, std::numbers::pi}};
const Vector phi{{0.0, 0.7, 2.0, 5.5, 0.0}};

Vector3 direction(vehd::Index i) {
  return {std::sin(theta(i)) * std::cos(phi(i)), std::sin(theta(i)) * std::sin(phi(i)), std::cos(theta(i))};
}

/// Largest distance between the shape and radius(i) times the direction at the test points.
template <typename Radius>
double error_of(const std::string& text, const Radius& radius) {
  const Matrix points = vehd::evaluate_harmonics(vehd::initial_position(parsed(text)), theta, phi);
  double error = 0.0;
  for (vehd::Index i = 0; i < theta.size(); ++i) {
    error = std::max(error, (points.row(i).transpose() - radius(i) * direction(i)).norm());
  }
  return error;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(initial_shape)

BOOST_AUTO_TEST_CASE(ellipsoid_has_the_given_axes) {
  const Matrix points = vehd::evaluate_harmonics(
      vehd::initial_position(parsed("[shape]\nkind='ellipsoid'\naxes=[1,2,3]\n[numerics]\ndt=1\nend_time=1\n")), theta,
      phi);
  for (vehd::Index i = 0; i < theta.size(); ++i) {
    const Vector3 expected = Vector3(1, 2, 3).cwiseProduct(direction(i));
    BOOST_TEST((points.row(i).transpose() - expected).norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(radial_mode_is_the_harmonic_of_equation_17) {
  // Y_2^1 = sqrt(5/4π · 1!/3!) 3 sinθ cosθ e^{iφ}
  const double factor = std::sqrt(5.0 / (4.0 * std::numbers::pi) / 6.0) * 3.0;
  const std::string numerics = "[numerics]\norder=12\ndt=1\nend_time=1\n";
  const auto radius = [&](auto trigonometric, vehd::Index i) {
    return 1.5 + 0.1 * factor * std::sin(theta(i)) * std::cos(theta(i)) * trigonometric(phi(i));
  };
  BOOST_TEST(error_of("[shape]\nkind='radial'\nbase=1.5\nmodes=[{n=2,m=1,a=0.1}]\n" + numerics,
                      [&](vehd::Index i) { return radius([](double x) { return std::cos(x); }, i); }) < 1e-13);
  BOOST_TEST(error_of("[shape]\nkind='radial'\nbase=1.5\nmodes=[{n=2,m=-1,a=0.1}]\n" + numerics,
                      [&](vehd::Index i) { return radius([](double x) { return std::sin(x); }, i); }) < 1e-13);
}

BOOST_AUTO_TEST_CASE(shape_33_converges_with_the_order) {
  // Y_3^2 = sqrt(7/4π · 1!/5!) 15 sin²θ cosθ e^{2iφ}
  const double factor = std::sqrt(7.0 / (4.0 * std::numbers::pi) / 120.0) * 15.0;
  const auto error = [&](int order) {
    return error_of(
        "[shape]\nkind='radial'\nbase=1\namplitude=0.2\nexponent=-3\nmodes=[{n=3,m=2,a=1}]\n[numerics]\n"
        "dt=1\nend_time=1\norder=" +
            std::to_string(order) + "\n",
        [&](vehd::Index i) {
          const double s = factor * std::pow(std::sin(theta(i)), 2) * std::cos(theta(i)) * std::cos(2.0 * phi(i));
          return 1.0 + 0.2 * std::exp(-3.0 * s);
        });
  };
  BOOST_TEST(error(16) < error(8) / 10.0);
  BOOST_TEST(error(48) < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
