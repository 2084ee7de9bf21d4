#include "bie/sphere/principal_axes.hpp"

#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>

using namespace vehd;

BOOST_AUTO_TEST_SUITE(principal_axes_suite)

BOOST_AUTO_TEST_CASE(a_rotated_tensor_has_the_axes_it_was_rotated_to) {
  const Matrix3 rotation = Eigen::AngleAxisd(0.7, Vector3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  const Vector3 values(-1.5, 0.25, 4.0);
  const PrincipalAxes found = principal_axes(rotation * values.asDiagonal() * rotation.transpose());
  BOOST_TEST((found.values - values).norm() <= 1e-14 * values.norm());
  for (int i = 0; i < 3; ++i) {
    BOOST_TEST(std::abs(found.directions.col(i).dot(rotation.col(i))) >= 1.0 - 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()
