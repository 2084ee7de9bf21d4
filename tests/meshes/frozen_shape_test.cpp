#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "tests/meshes/shapes.hpp"

using namespace vehd::meshes;
using namespace vehd::meshes::testing;

BOOST_AUTO_TEST_SUITE(frozen_shape)

BOOST_AUTO_TEST_CASE(prolate_has_the_area_and_volume_of_the_formula) {
  const FrozenShape shape = prolate();
  const double e = std::sqrt(0.75);
  BOOST_TEST(std::abs(shape.area() / (2.0 * std::numbers::pi * (1.0 + 2.0 / e * std::asin(e))) - 1.0) < 1e-13);
  BOOST_TEST(std::abs(shape.volume() / (8.0 / 3.0 * std::numbers::pi) - 1.0) < 1e-13);
  BOOST_TEST(shape.centroid().norm() < 1e-14);
  BOOST_TEST((shape.affine_part() - Matrix3(Point(1.0, 1.0, 2.0).asDiagonal())).norm() < 1e-13);
  BOOST_TEST(std::abs(shape.largest_distance(Point::Zero()) - 2.0) < 1e-2);
}

BOOST_AUTO_TEST_CASE(area_vector_is_the_normal_times_the_area_element) {
  // Prolate with axes a, a, c: n dA/dω = (c a x, c a y, a² z).
  const FrozenShape shape = prolate();
  for (const Point& r : {direction_of(0.0, 0.0), direction_of(1.2, 0.5), direction_of(2.6, 4.0)}) {
    BOOST_TEST((shape.area_vector(r) - Point(2.0 * r.x(), 2.0 * r.y(), r.z())).norm() < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(figures_move_with_the_shape) {
  const FrozenShape here = disc();
  const FrozenShape there = rotated_disc();
  BOOST_TEST(std::abs(there.area() / here.area() - 1.0) < 1e-8);
  BOOST_TEST(std::abs(there.volume() / here.volume() - 1.0) < 1e-13);
  BOOST_TEST((off_centre_sphere().centroid() - Point(0.4, -1.3, 0.7)).norm() < 1e-13);
}

BOOST_AUTO_TEST_CASE(disc_has_the_reduced_volume_it_is_meant_to_have) {
  const FrozenShape shape = disc();
  const double reduced = 6.0 * std::sqrt(std::numbers::pi) * shape.volume() / std::pow(shape.area(), 1.5);
  BOOST_TEST(std::abs(reduced - 0.65) < 1e-4);
}

BOOST_AUTO_TEST_CASE(shapes_inside_out_or_of_wrong_size_are_refused) {
  const Eigen::MatrixXd mirrored = project(1, [](const Point& r) { return Point(-r); });
  BOOST_CHECK_THROW(FrozenShape{mirrored}, MeshError);
  BOOST_CHECK_THROW(FrozenShape(Eigen::MatrixXd::Zero(4, 2)), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
