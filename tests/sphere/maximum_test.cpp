#include "bie/sphere/maximum.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/neighbourhood.hpp"
#include "tests/support/fields.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

double maximum_on(int grid_order, const Vector& coefficients, double sign = 1.0) {
  const SphereTransform transform(order_of(coefficients.size()), make_grid(grid_order));
  return maximum(transform.grid(), transform.synthesize_hessian(coefficients), 0, coefficients, sign);
}

/// Coefficients of degree ≤ 2 of a function on the unit sphere.
template <typename Function>
Vector quadratic(Function function) {
  const SphereTransform transform(2, make_grid(2));
  const SphereGrid& grid = transform.grid();
  Matrix values(grid.n_points(), 1);
  for (Index node = 0; node < grid.n_points(); ++node) values(node, 0) = function(direction(point_of(grid, node)));
  return transform.analyze(values);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(maximum_of_a_field)

// 1 − t² + t/2 with t along an axis has its maximum 17/16 on the ring t = 1/4 and its minimum −1/2 at one pole.
BOOST_AUTO_TEST_CASE(ring_and_pole_are_found_whatever_the_axis) {
  for (const Vector3& axis : {Vector3{0.0, 0.0, 1.0}, Vector3{1.0, 0.0, 0.0}, Vector3{0.3, -0.5, 0.8}.normalized()}) {
    const Vector field = quadratic([&](const Vector3& x) {
      const double t = axis.dot(x);
      return 1.0 - t * t + 0.5 * t;
    });
    for (const int grid_order : {6, 13, 24}) {
      BOOST_TEST(std::abs(maximum_on(grid_order, field) - 1.0625) < 1e-14);
      BOOST_TEST(std::abs(maximum_on(grid_order, field, -1.0) - 0.5) < 1e-14);
    }
  }
}

// A grid of twice the degree, as in runs, finds the same maximum as a grid ten times as fine.
BOOST_AUTO_TEST_CASE(no_grid_leaves_its_trace) {
  constexpr int kOrder = 6;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Vector field = random_coefficients(kOrder, 1, seed);
    const double fine = maximum_on(10 * kOrder, field);
    BOOST_TEST(std::abs(maximum_on(2 * kOrder, field) - fine) < 1e-13 * fine,
               "seed " << seed << ", off by " << maximum_on(2 * kOrder, field) - fine);
  }
}

// The node on a broad hump has a larger value than all nodes around a narrow hump, whose maximum is higher still.
BOOST_AUTO_TEST_CASE(broad_hump_does_not_hide_a_narrow_one) {
  constexpr int kOrder = 12;
  const SphereTransform transform(kOrder, make_grid(2 * kOrder));
  const SphereGrid& grid = transform.grid();
  const auto hump = [&](const Vector3& at, int sharpness) {
    Matrix values(grid.n_points(), 1);
    for (Index node = 0; node < grid.n_points(); ++node) {
      values(node, 0) = std::pow(0.5 * (1.0 + at.dot(direction(point_of(grid, node)))), sharpness);
    }
    return Vector(transform.analyze(values));
  };
  const Index row = grid.n_theta / 2;
  const Vector3 node = direction({grid.theta[row], grid.phi[0]});
  const Vector3 between =
      direction({0.5 * (grid.theta[row] + grid.theta[row + 1]), std::numbers::pi + 0.5 * grid.phi[1]});
  for (const double excess : {1e-3, 3e-3, 1e-2}) {
    const Vector field = hump(node, 1) + (1.0 + excess) * hump(between, kOrder);
    const double fine = maximum_on(10 * kOrder, field);
    BOOST_TEST(std::abs(maximum_on(2 * kOrder, field) - fine) < 1e-13 * fine,
               "excess " << excess << ", off by " << maximum_on(2 * kOrder, field) - fine);
  }
}

BOOST_AUTO_TEST_CASE(flat_field_is_its_own_maximum) {
  const Vector none = Vector::Zero(n_coefficients(4));
  BOOST_TEST(maximum_on(8, none) == 0.0);
  Vector constant = none;
  constant[0] = std::sqrt(4.0 * std::numbers::pi) * 3.0;
  BOOST_TEST(std::abs(maximum_on(8, constant) - 3.0) < 1e-14);
  BOOST_TEST(std::abs(maximum_on(8, constant, -1.0) + 3.0) < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
