#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/stepping/evaluation/wrinkling.hpp"
#include "bie/stepping/thresholds.hpp"
#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

constexpr int kCompressedOrder = 12;

double growth_at_start(const Model& model, const Matrix& position) {
  Instruments instruments;
  const Discretisation discretisation = discretisation_of(kCompressedOrder);
  const State state = start(model, discretisation, position, 0.1);
  return growth_of_wrinkles(model, state, evaluate(model, discretisation, state, instruments));
}

}  // namespace

BOOST_AUTO_TEST_SUITE(growth)

// The shape changes within radius/speed, with the largest normal speed at the start of a shear.
BOOST_AUTO_TEST_CASE(wrinkles_of_a_compressed_membrane_grow_until_its_shape_has_changed) {
  const Model model = shear_model();
  const Matrix position = ellipsoid(kCompressedOrder, {2.0, 1.0, 1.0});
  Instruments instruments;
  const Discretisation discretisation = discretisation_of(kCompressedOrder);
  const State state = start(model, discretisation, position, 0.1);
  const Evaluation found = evaluate(model, discretisation, state, instruments);
  const VesicleDiagnostics& now = found.diagnostics.vesicles[0];
  const double radius = std::sqrt(now.area / (4.0 * std::numbers::pi));
  const double rate = wrinkling_rate(flow_parameters(model, model.vesicles[0]), now.tension_integral / now.area, radius,
                                     kCompressedOrder);
  BOOST_REQUIRE(rate > 0.0);
  const Membrane& membrane = *found.vesicles[0].membrane;
  const Matrix velocity = membrane.fine.synthesize(found.fields.vesicles[0].velocity);
  const double speed = velocity.cwiseProduct(membrane.surface.normal).rowwise().sum().cwiseAbs().maxCoeff();
  const double growth = growth_of_wrinkles(model, state, found);
  BOOST_TEST(growth > 1.02);
  BOOST_TEST(growth < thresholds::most_growth);
  BOOST_TEST(growth == std::exp(rate * radius / speed), boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(nothing_is_expected_to_grow_beyond_the_most) {
  Model soft = field_model();
  soft.vesicles[0].bending = BendingParameters{1e-6};
  BOOST_TEST(growth_at_start(soft, prolate(kCompressedOrder)) == thresholds::most_growth);
}

BOOST_AUTO_TEST_CASE(nothing_grows_on_membranes_that_are_stretched_or_frozen_or_spheres) {
  Model stretched = relaxation_model(0.1);
  stretched.flow = axisymmetric_extension(10.0);
  BOOST_TEST(growth_at_start(stretched, prolate(kCompressedOrder)) == 1.0);
  Model frozen = field_model();
  frozen.mobile = false;
  BOOST_TEST(growth_at_start(frozen, prolate(kCompressedOrder)) == 1.0);
  BOOST_TEST(growth_at_start(field_model(), sphere(kCompressedOrder)) == 1.0);
}

BOOST_AUTO_TEST_SUITE_END()
