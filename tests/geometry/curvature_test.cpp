#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/geometry/surface.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

SphereTransform fine_transform(int order) { return {order, make_grid(2 * order)}; }

}  // namespace

BOOST_AUTO_TEST_SUITE(curvature)

BOOST_AUTO_TEST_CASE(sphere_has_outward_normal_and_mean_curvature_minus_one) {
  const SphereTransform transform = fine_transform(8);
  const Surface s = make_surface(transform, sphere(8));
  BOOST_TEST(max_difference(s.normal, s.position) < 1e-13);
  BOOST_TEST(max_difference(s.mean_curvature, Vector::Constant(s.n_points(), -1.0)) < 1e-12);
  BOOST_TEST(max_difference(s.gauss_curvature, Vector::Ones(s.n_points())) < 1e-12);
  BOOST_TEST(max_difference(s.area_element, Vector::Ones(s.n_points())) < 1e-13);
}

BOOST_AUTO_TEST_CASE(curvatures_scale_with_the_radius_wherever_the_centre_is) {
  const double radius = 2.5;
  const Vector3 centre(3.0, -1.0, 0.7);
  const SphereTransform transform = fine_transform(8);
  const Surface s = make_surface(transform, translated(sphere(8, radius), centre));
  BOOST_TEST(max_difference(s.normal, (s.position.rowwise() - centre.transpose()) / radius) < 1e-13);
  BOOST_TEST(max_difference(s.mean_curvature, Vector::Constant(s.n_points(), -1.0 / radius)) < 1e-12);
  BOOST_TEST(max_difference(s.gauss_curvature, Vector::Constant(s.n_points(), 1.0 / (radius * radius))) < 1e-12);
  BOOST_TEST(std::abs(surface_area(s) / (4.0 * std::numbers::pi * radius * radius) - 1.0) < 1e-13);
  BOOST_TEST(std::abs(enclosed_volume(s) / (4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3)) - 1.0) < 1e-13);
}

BOOST_AUTO_TEST_CASE(prolate_has_the_curvatures_of_the_formula) {
  // Axes a, a, c with w = c² sin²θ + a² cos²θ: principal curvatures a c/w^{3/2} and c/(a √w).
  const double a = 1.0;
  const double c = 2.0;
  const SphereTransform transform = fine_transform(8);
  const Surface s = make_surface(transform, prolate(8));
  const Eigen::ArrayXd theta = grid_angles(transform.grid()).theta.array();
  const Eigen::ArrayXd w = c * c * theta.sin().square() + a * a * theta.cos().square();
  const Eigen::ArrayXd meridian = a * c / (w * w.sqrt());
  const Eigen::ArrayXd parallel = c / (a * w.sqrt());
  BOOST_TEST(max_difference(s.mean_curvature, -0.5 * (meridian + parallel)) < 1e-12);
  BOOST_TEST(max_difference(s.gauss_curvature, meridian * parallel) < 1e-12);
  BOOST_TEST(max_difference(s.area_element, a * w.sqrt()) < 1e-13);
}

BOOST_AUTO_TEST_CASE(prolate_has_the_area_and_volume_of_the_formula) {
  const double e = std::sqrt(0.75);
  const double area = 2.0 * std::numbers::pi * (1.0 + 2.0 / e * std::asin(e));
  const double volume = 8.0 / 3.0 * std::numbers::pi;
  for (const bool moved : {false, true}) {
    const SphereTransform transform = fine_transform(16);
    const Surface s = make_surface(transform, moved ? move_poles(prolate(16), general_rotation()) : prolate(16));
    BOOST_TEST(std::abs(surface_area(s) / area - 1.0) < 1e-12);
    BOOST_TEST(std::abs(enclosed_volume(s) / volume - 1.0) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(area_element_alone_is_that_of_the_surface) {
  const SphereTransform transform = fine_transform(24);
  const Matrix position = move_poles(asymmetric_shape(24), general_rotation());
  const Vector expected = make_surface(transform, position).area_element;
  BOOST_TEST(max_difference(area_element(transform, position), expected) < 1e-13 * expected.maxCoeff());
}

BOOST_AUTO_TEST_CASE(gauss_curvature_integrates_to_four_pi) {
  for (const bool moved : {false, true}) {
    const Matrix position = asymmetric_shape(24);
    const SphereTransform transform = fine_transform(24);
    const Surface s = make_surface(transform, moved ? move_poles(position, general_rotation()) : position);
    BOOST_TEST(std::abs(s.gauss_curvature.dot(s.quadrature) / (4.0 * std::numbers::pi) - 1.0) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(curvature_of_a_point_does_not_depend_on_the_poles) {
  // Two parametrisations of the same surface; invariants are compared by integrals, which use every point.
  const SphereTransform transform = fine_transform(24);
  const Surface s = make_surface(transform, asymmetric_shape(24));
  const Surface moved = make_surface(transform, move_poles(asymmetric_shape(24), general_rotation()));
  for (const int power : {1, 2, 4}) {
    const auto moment = [power](const Surface& surface) {
      return surface.mean_curvature.array().pow(power).matrix().dot(surface.quadrature);
    };
    BOOST_TEST(std::abs(moment(moved) / moment(s) - 1.0) < 1e-10);
  }
}

BOOST_AUTO_TEST_CASE(volume_and_area_ignore_the_origin) {
  const SphereTransform transform = fine_transform(16);
  const Surface here = make_surface(transform, asymmetric_shape(16));
  const Surface there = make_surface(transform, translated(asymmetric_shape(16), {5.0, -7.0, 2.0}));
  BOOST_TEST(std::abs(surface_area(there) / surface_area(here) - 1.0) < 1e-13);
  BOOST_TEST(std::abs(enclosed_volume(there) / enclosed_volume(here) - 1.0) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
