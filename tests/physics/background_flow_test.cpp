#include "bie/physics/effects/background_flow.hpp"

#include <boost/test/unit_test.hpp>

using namespace vehd;

namespace {

bool gives(const BackgroundFlow& flow, const Vector3& at, const Vector3& velocity) {
  return (flow.gradient * at - velocity).norm() < 1e-15;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(background_flow)

BOOST_AUTO_TEST_CASE(named_flows_are_the_written_fields) {
  const Vector3 x(1.0, 2.0, 3.0);
  BOOST_TEST(gives(shear_flow(2.0), x, {6.0, 0.0, 0.0}));
  BOOST_TEST(gives(planar_extension(2.0), x, {2.0, 0.0, -6.0}));
  BOOST_TEST(gives(axisymmetric_extension(2.0), x, {-1.0, -2.0, 6.0}));
  BOOST_TEST(gives(BackgroundFlow{}, x, Vector3::Zero()));
}

BOOST_AUTO_TEST_CASE(named_flows_are_incompressible) {
  for (const BackgroundFlow& flow : {shear_flow(1.7), planar_extension(1.7), axisymmetric_extension(1.7)}) {
    BOOST_TEST(flow.gradient.trace() == 0.0);
  }
}

BOOST_AUTO_TEST_SUITE_END()
