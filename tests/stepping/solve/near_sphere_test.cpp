#include <Eigen/Geometry>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

namespace {

/// A nearly spherical prolate, inclined in the plane of the shear.
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

// Positions of degree p have normal parts of degree p + 1, which no force of degree p can balance. If a step ignores
// them, their tension is explicit, and the last degree grows by a factor of ten and more per step, at every order.
BOOST_AUTO_TEST_CASE(a_taut_membrane_keeps_still_at_any_step_and_order) {
  constexpr int kDegree = 12;
  // Without a mirror in z, so that degree 13 does not vanish.
  const SphereTransform transform(kDegree, make_grid(2 * kDegree));
  Vector rho = std::sqrt(4.0 * std::numbers::pi) * harmonic(kDegree, 0, 0);
  rho[coefficient_index(2, 0)] = -0.1;
  rho[coefficient_index(3, 0)] = 0.04;
  rho[coefficient_index(4, 0)] = 0.05;
  const Matrix start_shape =
      transform.analyze(transform.synthesize(rho).col(0).asDiagonal() * grid_directions(transform.grid()));
  Model model = relaxation_model(1e-3);
  model.flow = axisymmetric_extension(-1.0);
  const auto tail = [](const State& state) {
    const Matrix& x = state.vesicles[0].position;
    return x.bottomRows(2 * kDegree + 1).norm() / x.norm();
  };
  const Discretisation first_order = discretisation_of(kDegree);
  const State settled = run(model, first_order, start(model, first_order, start_shape, 0.02), 0.02, 50);
  for (const int time_order : {1, 2, 4}) {
    NumericalSettings settings;
    settings.order = kDegree;
    settings.time_order = time_order;
    const Discretisation discretisation(settings);
    // The mean tension over the viscosity and the radius is 20.
    for (const double dt : {0.2, 0.4}) {
      double largest = 0.0;
      run(model, discretisation, settled, dt, 8, [&](const State& state) { largest = std::max(largest, tail(state)); });
      BOOST_TEST_CONTEXT("order " << time_order << ", dt " << dt) { BOOST_TEST(largest < 3.0 * tail(settled)); }
    }
  }
}

// Holding the tension changes a step only by the order of its own error: halving dt halves the error.
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
