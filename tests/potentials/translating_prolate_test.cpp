#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// Speed of the 2:1 prolate under the density (x·n) e, total force 3V e = 8π e, from its resistance 6πμ·2·factor
/// (Oberbeck; Kim & Karrila, Microhydrodynamics, Table 3.4).
struct ProlateSpeeds {
  double along, across;
};

ProlateSpeeds exact_speeds() {
  const double e = std::sqrt(0.75);
  const double logarithm = std::log((1.0 + e) / (1.0 - e));
  const double along = 8.0 / 3.0 * e * e * e / (-2.0 * e + (1.0 + e * e) * logarithm);
  const double across = 16.0 / 3.0 * e * e * e / (2.0 * e + (3.0 * e * e - 1.0) * logarithm);
  return {2.0 / (3.0 * along), 2.0 / (3.0 * across)};
}

/// Largest deviation of the velocity from the exact constant, relative to it.
double translation_error(const Space& space, const Matrix& position, const Matrix& values, const Vector3& axis,
                         double speed) {
  const Surface surface = make_surface(space.fine, position);
  const StokesOperator layer = assemble(space, position, kStokesLayer).stokes_single;
  const Matrix velocity = space.fine.synthesize(layer.apply(weighted(space, surface, values * axis.transpose())));
  return (velocity.rowwise() - speed * axis.transpose()).cwiseAbs().maxCoeff() / speed;
}

double prolate_error(int order, const Vector3& axis, double speed, bool poles_on_axis) {
  const Space space(order);
  const Matrix position = poles_on_axis ? prolate(order) : move_poles(prolate(order), general_rotation());
  const Surface surface = make_surface(space.fine, position);
  return translation_error(space, position, row_dot(surface.position, surface.normal), axis, speed);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(translating_prolate)

BOOST_AUTO_TEST_CASE(support_function_density_moves_it_at_the_exact_constant_velocity) {
  const ProlateSpeeds exact = exact_speeds();
  for (const bool poles_on_axis : {true, false}) {
    BOOST_TEST_CONTEXT((poles_on_axis ? "poles on the axis" : "poles elsewhere")) {
      BOOST_TEST(prolate_error(16, Vector3::UnitZ(), exact.along, poles_on_axis) < 1e-7);
      BOOST_TEST(prolate_error(16, Vector3::UnitX(), exact.across, poles_on_axis) < 1e-7);
      BOOST_TEST(prolate_error(32, Vector3::UnitZ(), exact.along, poles_on_axis) < 5e-12);
      BOOST_TEST(prolate_error(32, Vector3::UnitX(), exact.across, poles_on_axis) < 5e-12);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
