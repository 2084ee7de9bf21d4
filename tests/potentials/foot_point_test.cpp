#include "bie/potentials/foot_point.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/potentials/graded_rule.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/targets.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// Unit vector 0.1 rad away from the direction of the angles.
Vector3 start_near(double theta, double phi) {
  return {std::sin(theta + 0.1) * std::cos(phi), std::sin(theta + 0.1) * std::sin(phi), std::cos(theta + 0.1)};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(foot_point)

BOOST_AUTO_TEST_CASE(nearest_point_is_found_from_both_sides_at_poles_and_elsewhere) {
  const Matrix position = asymmetric_shape(12);
  const GridAngles angles = scattered_angles(60);
  const MembranePoints points = membrane_points(position, angles);
  for (const double height : {-0.1, -1e-3, -1e-7, 1e-7, 1e-3, 0.1}) {
    const Matrix targets = points.at_height(height);
    double distance = 0.0;
    double height_error = 0.0;
    for (Index i = 0; i < targets.rows(); ++i) {
      const FootPoint foot =
          find_foot_point(position, start_near(angles.theta[i], angles.phi[i]), targets.row(i).transpose());
      distance = std::max(distance, (foot.position - points.position.row(i).transpose()).norm());
      height_error = std::max(height_error, std::abs(foot.height - height));
    }
    BOOST_TEST_CONTEXT("height " << height) {
      BOOST_TEST(distance < 1e-12);
      BOOST_TEST(height_error < 1e-14);
    }
  }
}

BOOST_AUTO_TEST_CASE(stretches_describe_the_distance_around_the_foot_point) {
  // Sphere of radius R: |x − y|² = h² + 2R(R + h)(1 − cos t).
  const double radius = 1.4;
  for (const double height : {-0.9, 0.0, 0.5}) {
    const Vector3 target = (radius + height) * Vector3(0.6, 0.0, 0.8);
    const FootPoint foot = find_foot_point(sphere(6, radius), Vector3(0.5, 0.1, 0.8).normalized(), target);
    BOOST_TEST(std::abs(foot.smallest_stretch - std::sqrt(radius * (radius + height))) < 1e-13);
    BOOST_TEST(std::abs(foot.largest_stretch - std::sqrt(radius * (radius + height))) < 1e-13);
  }
  // Axes 1, 1, 2 at the equator: the tangents have lengths 2 and 1.
  const FootPoint foot = find_foot_point(prolate(6), Vector3(1.0, 0.1, 0.1).normalized(), {1.0, 0.0, 0.0});
  BOOST_TEST(std::abs(foot.smallest_stretch - 1.0) < 1e-13);
  BOOST_TEST(std::abs(foot.largest_stretch - 2.0) < 1e-13);
}

BOOST_AUTO_TEST_CASE(centre_of_curvature_is_no_trap) {
  const FootPoint foot = find_foot_point(sphere(6), Vector3(0.6, 0.0, 0.8), Vector3::Zero());
  BOOST_TEST(std::abs(foot.height + 1.0) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(graded_rule)

BOOST_AUTO_TEST_CASE(differences_from_the_pole_keep_their_digits_at_tiny_angles) {
  // T_n0(t) − T_n0(0) = −√((2n+1)/4π) n(n+1)/4 t² to leading order.
  constexpr int kOrder = 20;
  const GradedRule rule = make_graded_rule(kOrder, 1e-9, 60, 8);
  const double t = rule.theta[3];
  BOOST_REQUIRE(t < 1e-8);
  for (int n = 1; n <= kOrder; ++n) {
    const double expected = -std::sqrt((2.0 * n + 1.0) / (4.0 * std::numbers::pi)) * n * (n + 1.0) / 4.0 * t * t;
    BOOST_TEST(std::abs(rule.synthesis[0](3, n) / expected - 1.0) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(measures_the_sphere_and_a_peak_at_the_pole) {
  // ∫ dω = 4π, and ∫ (1 − cos t + s²)^{−3/2} dω = 4π (1/s − 1/√(2 + s²)): s is the width of the peak.
  for (const double scale : {1.0, 1e-3, 1e-8}) {
    const GradedRule rule = make_graded_rule(16, scale, 92, 8);
    const double s = scale / std::numbers::sqrt2;
    const Eigen::ArrayXd sine = (0.5 * rule.theta.array()).sin();
    const double peak = ((2.0 * sine.square() + s * s).pow(-1.5)).matrix().dot(rule.weight) * rule.n_phi;
    BOOST_TEST_CONTEXT("scale " << scale) {
      BOOST_TEST(std::abs(rule.weight.sum() * rule.n_phi / (4.0 * std::numbers::pi) - 1.0) < 1e-12);
      BOOST_TEST(std::abs(peak / (4.0 * std::numbers::pi * (1.0 / s - 1.0 / std::sqrt(2.0 + s * s))) - 1.0) < 1e-11);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
