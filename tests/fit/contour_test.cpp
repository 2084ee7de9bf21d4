#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/fit/run_values.hpp"
#include "tests/support/shapes.hpp"

BOOST_AUTO_TEST_SUITE(contours, *boost::unit_test::label("once"))

// r² (cos²φ/a² + sin²φ/c²) = 1, wherever the ellipsoid is.
BOOST_AUTO_TEST_CASE(that_of_an_ellipsoid_is_an_ellipse) {
  vehd::Matrix position = vehd::testing::ellipsoid(16, {1.0, 0.8, 1.7});
  position = vehd::testing::translated(position, {3.0, -2.0, 5.0});
  std::vector<double> angles;
  for (int k = 0; k < 12; ++k) angles.push_back(30.0 * k);
  const std::vector<double> radii = vehd::section_radii(position, angles);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double phi = angles[k] * std::numbers::pi / 180.0;
    const double exact = 1.0 / std::hypot(std::cos(phi) / 1.0, std::sin(phi) / 1.7);
    BOOST_TEST(radii[k] == exact, boost::test_tools::tolerance(1e-10));
  }
}

BOOST_AUTO_TEST_SUITE_END()
