#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// A prolate all but a sphere, inclined in the plane of the shear.
Matrix inclined_prolate(double long_axis) {
  const Matrix3 rotation = Eigen::AngleAxisd(0.87, Vector3::UnitY()).toRotationMatrix();
  return ellipsoid(10, {1.0, 1.0, long_axis}) * rotation.transpose();
}

}  // namespace

BOOST_AUTO_TEST_SUITE(near_sphere)

// The less excess area, the larger the tension that holds it, and the faster a disturbance relaxes under it. An
// explicit tension overshoots from step to step: steps fail, and the spectrum rises to 1e-4.
BOOST_AUTO_TEST_CASE(first_order_steps_do_not_ring_however_near_the_sphere) {
  const Discretisation discretisation = discretisation_of(10);
  for (const double long_axis : {1.07, 1.03}) {
    BOOST_TEST_CONTEXT("long axis " << long_axis) {
      const Model model = shear_model();
      const double dt = 0.05;
      double tail = 0.0;
      run(model, discretisation, start(model, discretisation, inclined_prolate(long_axis), dt), dt, 60,
          [&](const State& state) {
            if (state.step > 20)
              tail = std::max(tail, evaluated(model, discretisation, state).diagnostics.spectrum_tail);
          });
      BOOST_TEST(tail < 1e-6);
    }
  }
}

// What is held changes steps by their own order: halving dt halves the error.
BOOST_AUTO_TEST_CASE(held_tension_leaves_the_first_order_step_of_first_order) {
  const Discretisation discretisation = discretisation_of(10);
  const Model model = shear_model();
  const auto inclination = [&](double dt) {
    const State end = run(model, discretisation, start(model, discretisation, inclined_prolate(1.07), dt), dt,
                          static_cast<int>(std::lround(0.4 / dt)));
    return evaluated(model, discretisation, end).diagnostics.inclination_deg;
  };
  const double coarse = inclination(0.05), middle = inclination(0.025), fine = inclination(0.0125);
  BOOST_TEST(std::abs(middle - fine) < 0.75 * std::abs(coarse - middle));
}

BOOST_AUTO_TEST_SUITE_END()
