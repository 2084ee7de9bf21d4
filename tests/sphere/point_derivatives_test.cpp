#include "bie/sphere/point_derivatives.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "tests/support/fields.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(point_derivatives)

BOOST_AUTO_TEST_CASE(derivatives_at_a_point_are_those_of_the_transform) {
  const SphereTransform transform(9, make_grid(12));
  const Matrix fields = random_coefficients(9, 2, 51);
  const SphereDerivatives expected = transform.synthesize_hessian(fields);
  const GridAngles angles = grid_angles(transform.grid());
  double difference = 0.0;
  for (Index i = 0; i < angles.theta.size(); ++i) {
    const PointDerivatives p = vehd::point_derivatives(fields, {angles.theta[i], angles.phi[i]});
    difference =
        std::max({difference, max_difference(p.value, expected.value.row(i)), max_difference(p.d1, expected.d1.row(i)),
                  max_difference(p.d2, expected.d2.row(i)), max_difference(p.d11, expected.d11.row(i)),
                  max_difference(p.d12, expected.d12.row(i)), max_difference(p.d22, expected.d22.row(i))});
  }
  BOOST_TEST(difference < 1e-10);
}

BOOST_AUTO_TEST_SUITE_END()
