#include "fem_check/app/surface_transport.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/fem_check/cases.hpp"

BOOST_AUTO_TEST_SUITE(surface_transport)

namespace {

using namespace vehd::fem_check;
using namespace vehd::fem_check::testing;

/// Error of w·∇_γ u on the sphere, for u = c·x and a w that is not tangential, at the points of a mesh.
double error_on_the_sphere(int points_per_edge) {
  const Discretisation space = discretise(unit_sphere(), {.cells_per_edge = 1, .shell_layers = 1, .degree = 2});
  const SurfacePoints rule = space.quadrature_points(points_per_edge);
  const Vector3 c(0.4, -1.0, 0.7);
  Vectors velocity(3, rule.size());
  Vector exact(rule.size());
  for (Eigen::Index i = 0; i < rule.size(); ++i) {
    const Vector3 r = rule.direction.col(i);
    velocity.col(i) = Vector3(1.0 + r.y(), -0.5 * r.z(), 2.0 * r.x());
    exact[i] = velocity.col(i).dot(c - c.dot(r) * r);
  }
  const Vector found =
      vehd::fem_check::surface_transport(rule, rule.direction, velocity, rule.direction.transpose() * c);
  return relative_l2(rule, found.transpose(), exact.transpose());
}

}  // namespace

BOOST_AUTO_TEST_CASE(gradient_along_a_sphere_is_the_tangential_part) {
  BOOST_TEST(error_on_the_sphere(6) < 1e-3);
  BOOST_TEST(error_on_the_sphere(10) < 1e-5);
}

BOOST_AUTO_TEST_SUITE_END()
