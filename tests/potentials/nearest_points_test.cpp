#include "bie/potentials/nearest_points.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(nearest_points_of_membranes)

BOOST_AUTO_TEST_CASE(gaps_of_spheres_are_exact) {
  const Matrix small = sphere(8);
  for (const double gap : {1e-6, 1e-3, 0.1, 10.0}) {
    const Vector3 way = (2.0 + gap) * Vector3(0.3, -0.5, 0.7).normalized();
    const NearestPoints found = nearest_points(small, translated(small, way));
    BOOST_TEST(std::abs(found.gap - gap) < 1e-12);
    BOOST_TEST((found.on_first - way.normalized()).norm() < 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(poles_are_no_special_points) {
  const Matrix shape = ellipsoid(10, {1.0, 1.2, 1.5});
  const NearestPoints found = nearest_points(translated(shape, {0.0, 0.0, -1.75}), translated(shape, {0.0, 0.0, 1.75}));
  BOOST_TEST(std::abs(found.gap - 0.5) < 1e-12);
  BOOST_TEST((found.on_second - Vector3(0.0, 0.0, 0.25)).norm() < 1e-9);
}

// The points are in reversed order: the second lies inside the first membrane.
BOOST_AUTO_TEST_CASE(membranes_that_meet_have_no_gap) {
  const Matrix shape = sphere(8);
  BOOST_TEST(nearest_points(shape, translated(shape, {1.9, 0.0, 0.0})).gap < 1e-6);
}

BOOST_AUTO_TEST_CASE(the_closest_of_several_are_found) {
  const Matrix shape = sphere(8);
  const std::vector<Matrix> shapes{shape, translated(shape, {5.0, 0.0, 0.0}), translated(shape, {0.0, 9.0, 0.0}),
                                   translated(shape, {5.0, 2.3, 0.0})};
  const std::vector<ClosePair> closest = close_pairs(shapes, 0.0);
  BOOST_TEST(closest.size() == 1);
  BOOST_TEST(closest[0].first == 1);
  BOOST_TEST(closest[0].second == 3);
  BOOST_TEST(std::abs(closest[0].points.gap - 0.3) < 1e-12);
  // The first and the second are 3 apart, the first and the fourth 3.5037.
  const std::vector<ClosePair> close = close_pairs(shapes, 3.4);
  BOOST_TEST(close.size() == 2);
  BOOST_TEST(close[1].first == 0);
  BOOST_TEST(close[1].second == 1);
  BOOST_TEST(std::abs(close[1].points.gap - 3.0) < 1e-12);
  BOOST_TEST(close_pairs({shape}, 3.4).empty());
}

BOOST_AUTO_TEST_CASE(arrangements_of_two_membranes_are_recognised) {
  const Matrix shape = ellipsoid(10, {1.0, 1.2, 1.5});
  const Matrix small = 0.2 * shape;
  BOOST_TEST((arrangement_of(shape, translated(shape, {2.001, 0.0, 0.0})) == Arrangement::apart));
  BOOST_TEST((arrangement_of(shape, translated(shape, {1.999, 0.0, 0.0})) == Arrangement::intersecting));
  BOOST_TEST((arrangement_of(shape, shape) == Arrangement::intersecting));
  BOOST_TEST((arrangement_of(shape, translated(small, {0.2, 0.1, 0.9})) == Arrangement::second_is_inside));
  BOOST_TEST((arrangement_of(translated(small, {0.2, 0.1, 0.9}), shape) == Arrangement::first_is_inside));
  BOOST_TEST((arrangement_of(shape, translated(small, {0.9, 0.0, 0.0})) == Arrangement::intersecting));
}

BOOST_AUTO_TEST_SUITE_END()
