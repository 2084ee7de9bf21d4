#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/runs.hpp"
#include "tests/support/shapes.hpp"

using namespace vehd;
using namespace vehd::testing;

BOOST_AUTO_TEST_SUITE(evolution)

BOOST_AUTO_TEST_CASE(energy_never_rises_in_relaxation) {
  const Discretisation discretisation = discretisation_of(12);
  for (const double dt : {0.05, 0.5}) {
    const Model model = relaxation_model(1.0);
    State state = start(model, discretisation, ellipsoid(12, {1.0, 1.3, 1.8}), dt);
    double last = evaluated(model, discretisation, state).diagnostics.bending_energy_scaled;
    const double first = last;
    run(model, discretisation, state, dt, 20, [&](const State& next) {
      const double energy = evaluated(model, discretisation, next).diagnostics.bending_energy_scaled;
      BOOST_TEST(energy <= last + 1e-9 * first);
      last = energy;
    });
    BOOST_TEST(last < first - 1e-3);
  }
}

BOOST_AUTO_TEST_CASE(area_and_volume_do_not_drift_in_shear) {
  const Discretisation discretisation = discretisation_of(12);
  const Model model = shear_model();
  const State state = start(model, discretisation, ellipsoid(12, {2.0, 1.0, 1.0}), 0.1);
  run(model, discretisation, state, 0.1, 20, [&](const State& next) {
    const VesicleDiagnostics d = evaluated(model, discretisation, next).diagnostics;
    BOOST_TEST(std::abs(d.area_drift) <= 1e-6);
    BOOST_TEST(std::abs(d.volume_drift) <= 1e-6);
  });
}

BOOST_AUTO_TEST_CASE(time_error_falls_with_at_least_first_order) {
  // A prolate in the field of Example 2; extents and V_m do not depend on the grid. At p = 8 the truncation error of
  // the energy is as large as the difference of two steps.
  const int order = 16;
  const Discretisation discretisation = discretisation_of(order);
  const Model model = field_model();
  const auto end = [&](int n_steps) {
    const double dt = 1.0 / n_steps;
    const State state = run(model, discretisation, start(model, discretisation, prolate(order), dt), dt, n_steps);
    const VesicleDiagnostics d = evaluated(model, discretisation, state).diagnostics;
    return std::array{d.extent_z, d.extent_x, d.Vm_north, d.bending_energy_scaled};
  };
  const auto coarse = end(8);
  const auto middle = end(16);
  const auto fine = end(32);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    const double ratio = std::abs(coarse[i] - middle[i]) / std::abs(middle[i] - fine[i]);
    BOOST_TEST(std::log2(ratio) > 0.9, "quantity " << i << ": order " << std::log2(ratio));
  }
}

BOOST_AUTO_TEST_CASE(result_does_not_depend_on_where_the_poles_are) {
  const int order = 16;
  const Discretisation discretisation = discretisation_of(order);
  const Model model = shear_model();
  const auto after = [&](const Matrix& position) {
    const State state = run(model, discretisation, start(model, discretisation, position, 0.1), 0.1, 5);
    return evaluated(model, discretisation, state).diagnostics;
  };
  const Matrix position = ellipsoid(order, {1.4, 1.0, 1.2});
  const VesicleDiagnostics here = after(position);
  const VesicleDiagnostics moved = after(move_poles(position, general_rotation()));
  BOOST_TEST(std::abs(here.inclination_deg - moved.inclination_deg) < 1e-3);
  BOOST_TEST(std::abs(here.extent_x - moved.extent_x) < 1e-5);
  BOOST_TEST(std::abs(here.bending_energy_scaled / moved.bending_energy_scaled - 1.0) < 1e-5);
}

BOOST_AUTO_TEST_CASE(turning_the_whole_scene_turns_the_result) {
  const int order = 10;
  const Discretisation discretisation = discretisation_of(order);
  const Matrix3 rotation = general_rotation();
  const Matrix position = ellipsoid(order, {1.4, 1.0, 1.2});
  Model model = shear_model();
  const State here = run(model, discretisation, start(model, discretisation, position, 0.1), 0.1, 5);
  model.flow->gradient = rotation * model.flow->gradient * rotation.transpose();
  const State rotated =
      run(model, discretisation, start(model, discretisation, position * rotation.transpose(), 0.1), 0.1, 5);
  BOOST_TEST(max_difference(rotated.vesicles[0].position, here.vesicles[0].position * rotation.transpose()) < 1e-7);
}

BOOST_AUTO_TEST_SUITE_END()
