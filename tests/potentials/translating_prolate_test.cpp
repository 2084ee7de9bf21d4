#include "bie/potentials/translating_prolate.hpp"

#include <boost/test/unit_test.hpp>

#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

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
  const ProlateSpeeds exact = translating_prolate_speeds();
  for (const bool poles_on_axis : {true, false}) {
    BOOST_TEST_CONTEXT((poles_on_axis ? "poles on the axis" : "poles elsewhere")) {
      BOOST_TEST(prolate_error(16, Vector3::UnitZ(), exact.along, poles_on_axis) < 1e-11);
      BOOST_TEST(prolate_error(16, Vector3::UnitX(), exact.across, poles_on_axis) < 1e-11);
      BOOST_TEST(prolate_error(32, Vector3::UnitZ(), exact.along, poles_on_axis) < 5e-12);
      BOOST_TEST(prolate_error(32, Vector3::UnitX(), exact.across, poles_on_axis) < 5e-12);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
