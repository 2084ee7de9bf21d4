#include "bie/stepping/evaluation/volume_moments.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(moments_of_volume)

namespace {

constexpr int kOrder = 16;
const Vector3 kAxes(0.7, 1.0, 1.4), kCentre(30.0, -2.0, 5.0);
const Matrix3 kTurn = Eigen::AngleAxisd(0.8, Vector3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();

Surface leaning_ellipsoid() {
  const SphereTransform fine(kOrder, make_grid(2 * kOrder));
  return make_surface(fine, translated(ellipsoid(kOrder, kAxes) * kTurn.transpose(), kCentre));
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_ellipsoid_has_its_centre_and_its_axes) {
  const VolumeMoments moments = volume_moments(leaning_ellipsoid());
  BOOST_TEST((moments.centroid - kCentre).norm() < 1e-12);
  const Matrix3 expected = kTurn * kAxes.cwiseAbs2().asDiagonal() * kTurn.transpose() / 5.0;
  BOOST_TEST((moments.spread - expected).norm() < 1e-10);
  BOOST_TEST(std::abs(moments.aspect_ratio() - 2.0) < 1e-10);
  const double along = 1.4 * 1.4, across = 0.5 * (0.7 * 0.7 + 1.0);
  BOOST_TEST(std::abs(moments.aspect_ratio_along(-3.0 * kTurn.col(2)) - std::sqrt(along / across)) < 1e-10);
}

// A motion x ↦ v + Ax carries the centroid along, whether it keeps area and volume or not.
BOOST_AUTO_TEST_CASE(the_centroid_moves_as_the_body_does) {
  const Surface s = leaning_ellipsoid();
  Matrix3 gradient;
  gradient << 0.3, -1.0, 0.2, 0.5, 0.1, 0.7, -0.4, 0.6, 0.9;
  const Vector3 velocity(1.0, -2.0, 0.5);
  const Matrix motion = (s.position * gradient.transpose()).rowwise() + velocity.transpose();
  const Vector3 expected = velocity + gradient * kCentre;
  BOOST_TEST((centroid_velocity(s, volume_moments(s), motion) - expected).norm() < 1e-9);
}

BOOST_AUTO_TEST_SUITE_END()
